"""A number that URDF readers cannot read, or a missing element or attribute.

urdfdom refuses the whole robot for a joint with such a fault. For a link, it drops the inertial or
the shape and everything after it in the link: the robot loads, and a part has no mass or touches
nothing. Such faults are a decimal comma, a unit, a word, `inf`, `nan`, and a blank behind a single
number. A number below 0 or above 1 in a colour only loses the colour.

Fix: write the number as the message says: with a decimal point, without unit, and with blanks only
between several numbers.
Source: urdfdom, `strToDouble`: nothing may follow the number; tried with check_urdf of urdfdom 6.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import (
    AttributeSpec,
    lacking_elements,
    specified_elements,
)
from checker.model.values import parse_number, short
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml import Element

_ONLY_LOOKS = ("color",)
"""urdfdom ignores a colour that it cannot read."""


@rule("URD012", "unreadable-urdf-value", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report what links and joints lack, and attributes that are not the numbers they should be."""
    for element, attributes in specified_elements(description.document):
        harmless = description.for_rviz or element.tag in _ONLY_LOOKS
        level = Severity.WARNING if harmless else None
        missing = [
            name
            for name, spec in attributes.items()
            if spec.required and element.attribute(name) is None
        ]
        if missing:
            message = f"<{element.tag}> has no {', '.join(missing)}"
            yield finding(element, message, severity=level, key=message)
        for name, spec in attributes.items():
            yield from _numbers(element, name, spec, level)
    for colour in description.document.root.descendants("color"):
        yield from _out_of_range(colour)
    for element, what in lacking_elements(description.document):
        message = f"<{element.tag}> has no {what}"
        level = Severity.WARNING if description.for_rviz else None
        yield finding(element, message, severity=level, key=message)


def _numbers(
    element: Element, name: str, spec: AttributeSpec, level: Severity | None
) -> Iterator[Finding]:
    text = element.attribute(name)
    if text is not None and spec.numbers and (problem := _problem(text, spec.numbers)):
        yield finding(text, f"{name} of <{element.tag}> {problem}", severity=level)


def _out_of_range(colour: Element) -> Iterator[Finding]:
    text = colour.attribute("rgba")
    values = [parse_number(word) for word in text.value.split()] if text is not None else []
    if text is not None and any(value is not None and not 0 <= value <= 1 for value in values):
        yield finding(
            text,
            f"rgba of <color> is {short(text.value)!r}, expected numbers from 0 to 1: URDF readers "
            "drop the colour",
            severity=Severity.WARNING,
            key="colour",
        )


def _problem(text: Located[str], count: int) -> str:
    """Return what is wrong with the numbers of an attribute; nothing if they can be read."""
    words = text.value.split()
    for word in words:
        value = parse_number(word)
        if value is None:
            return f"contains {short(word)!r}, which is not a number"
        if value in (float("inf"), float("-inf")):
            return f"is {word}, which URDF readers refuse; expected a finite number"
    if len(words) != count:
        expected = f"{count} numbers" if count > 1 else "one number"
        return f"has {len(words)} values, expected {expected}"
    if count == 1 and text.value != text.value.rstrip():
        return "ends with a blank, which URDF readers refuse"
    return ""


_MOMENTS = 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"'


def _link(mass: str = 'value="1"', moments: str = _MOMENTS, size: str = "1 1 1") -> dict[str, str]:
    inertial = f"<inertial>\n<mass {mass}/>{{mark}}\n<inertia {moments}/>\n</inertial>"
    shape = f'<collision><geometry>\n<box size="{size}"/>\n</geometry></collision>'
    joint = '<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>'
    return {"@urdf": f'<link name="tip">\n{inertial}\n{shape}\n</link>\n{joint}'}


def _marked(example: dict[str, str], line: str) -> dict[str, str]:
    text = example["@urdf"].replace("{mark}", "")
    return {"@urdf": text.replace(line, f"{line}  <!-- ^ URD012 -->", 1)}


GOOD = [_marked(_link(), "nothing"), _marked(_link(size=" 1  1e0 +1. "), "nothing")]
BAD = [
    _marked(_link('value="1,5"'), '<mass value="1,5"/>'),
    _marked(_link('value="1 "'), '<mass value="1 "/>'),
    _marked(_link('value="nan"'), '<mass value="nan"/>'),
    _marked(_link(""), "<mass />"),
    _marked(_link(moments=_MOMENTS.replace(' iyz="0"', "")), 'izz="1"/>'),
    _marked(_link(size="1 1"), '<box size="1 1"/>'),
    _marked(_link(size="1 inf 1"), '<box size="1 inf 1"/>'),
    {
        "@urdf": """
<material name="sand">
<color rgba="194 178 128 1"/>  <!-- ^ URD012 -->
</material>
<link name="tip"/>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>
"""
    },
]
