"""A material that is used but not defined.

RViz shows the part in its default colour: a `<material>` with only a name has the colour that the
robot defines under this name, and there is no such definition.

Fix: add `<material name="…"><color rgba="…"/></material>` to the robot, or correct the name.
Source: URDF specification, visual/material.
"""

from checker.base.words import Suggestions
from checker.formats.urdf.description import UrdfDescription
from checker.rule import Concern, Findings, Severity, misspelt, rule
from checker.source.xml import Element

_DEFINING = ("color", "texture")


@rule("URD010", "undefined-material", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report names of materials without a colour or texture in the file."""
    if description.call is not None:
        return  # A file that includes the macro may define them.
    root = description.document.root
    used = [
        material
        for link in root.all("link")
        for visual in link.all("visual")
        for material in visual.all("material")
    ]
    everywhere = (*root.all("material"), *used)
    defined = {material.get("name") or "" for material in everywhere if _defines(material)}
    names = Suggestions(sorted(defined - {""}))
    for material in used:
        name = material.attribute("name")
        if name is None or not name.value or name.value in defined or _defines(material):
            continue
        yield misspelt(name, f"material {name.value!r} is not defined", names, key=name.value)


def _defines(material: Element) -> bool:
    return any(material.child(tag) is not None for tag in _DEFINING)


_FILE = "urdf/robot_from_sdf.xacro"


def _robot(material: str, more: str = "") -> dict[str, str]:
    box = '<geometry><box size="1 1 1"/></geometry>'
    text = f"""<robot name="rover">
{more}
<link name="a"><visual>{box}
{material}
</visual></link></robot>
"""
    return {_FILE: text}


_GREEN = '<material name="green"><color rgba="0 1 0 1"/></material>'
_OTHER = f'<link name="b"><visual>{_GREEN}</visual></link>'
_MARK = "  <!-- ^ URD010 -->"
GOOD = [
    _robot('<material name="green"/>', _GREEN),
    _robot('<material name="green"/>', _OTHER),
    _robot(_GREEN),
    _robot('<material name=""/>'),
]
BAD = [
    _robot(f'<material name="green"/>{_MARK}'),
    _robot(f'<material name="gren"/>{_MARK}', _GREEN),
    _robot(f'<material name="green"/>{_MARK}', '<material name="green"/>'),
]
