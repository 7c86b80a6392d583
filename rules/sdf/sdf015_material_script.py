"""A material with a script.

Ignition Gazebo does not read OGRE material scripts: a part coloured only by a script is black.
Harmonic and later know the names of Gazebo's own materials (`Gazebo/Red`) and nothing else. If the
script is black too, or the material also has plain colours or PBR textures, which Gazebo uses, the
script does nothing. Only this rule checks `file://media` URIs of scripts.

Gazebo Classic reads scripts. One whose URI is a path in a home is found on the machine of its
author alone: elsewhere the part has no colour and no texture, and no camera sees its mark.

Fix: for Classic, write the folders of the script as `model://NAME/materials/scripts` and
`model://NAME/materials/textures`; for others, give `<ambient>`, `<diffuse>` and `<specular>`, or
`<pbr>` with textures of the package, and remove the script.
Source: Model Migration Guide and model reviews; gz-rendering reads no material scripts;
gz-sim8, rendering/MaterialParser.
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.formats.sdf.document import SdfDocument
from checker.package.uris import is_on_one_machine
from checker.rule import Concern, Context, Finding, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element
from checker.source.xml_insertion import removal

SCRIPTED = ("", "classic")
"""Releases that read scripts, and no particular release."""
MAPPING = ("harmonic", "ionic", "jetty")
"""Releases that know the colours of Gazebo's own materials by their names."""
BLACK = frozenset({"Gazebo/Black", "Gazebo/FlatBlack"})
_COLOURS = frozenset({"ambient", "diffuse", "specular", "emissive", "pbr"})


@rule("SDF015", "material-script", Severity.WARNING, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report scripts that the target does not read, and empty materials."""
    for element in sdf.elements():
        if element.tag != "material":
            continue
        script = element.child("script")
        if script is not None and context.release in SCRIPTED:
            yield from _on_one_machine(script)
        elif script is not None:
            yield from _script(element, script, mapped=context.release in MAPPING)
        elif not element.children and not element.text.stated:
            yield finding(
                element,
                "<material> is empty, so it has no effect",
                severity=Severity.INFO,
                fix=Fix(Safety.SAFE, (removal(element),)),
            )


def _on_one_machine(script: Element) -> Iterator[Finding]:
    for uri in script.all("uri"):
        if is_on_one_machine(uri.text.value):
            yield finding(
                uri,
                f"the material script is in {uri.text.value.strip()}, a path of one machine: "
                "elsewhere the part has no texture; write model://NAME/materials/…",
                key="machine",
            )


def _script(material: Element, script: Element, *, mapped: bool) -> Iterator[Finding]:
    name = script.child("name")
    if mapped and name is not None and name.text.value.startswith("Gazebo/"):
        return
    called = f" {name.text.value!r}" if name is not None and name.text.stated else ""
    if any(child.tag in _COLOURS for child in material.children):
        yield finding(
            script,
            f"Gazebo ignores the material script{called} and uses the material's other colours",
            severity=Severity.INFO,
            fix=Fix(Safety.SAFE, (removal(script),)),
        )
    elif name is not None and name.text.value.strip() in BLACK:
        yield finding(
            script,
            f"Gazebo ignores the material script{called}: the part is black without it",
            severity=Severity.INFO,
        )
    else:
        yield finding(
            script, f"Gazebo ignores the material script{called}, and the part has no other colour"
        )


def _visual(material: str) -> str:
    return f"""
<visual name="body">
  <geometry><box><size>1 1 1</size></box></geometry>
  {material}
</visual>
"""


_SCRIPT = "<script><uri>file://media/gazebo.material</uri><name>Gazebo/Red</name></script>"
GOOD = [_visual("<material><diffuse>1 0 0 1</diffuse></material>"), _visual("")]
BAD = [
    _visual(f"<material>{_SCRIPT}</material>  <!-- ^ SDF015 -->"),
    _visual(f"<material>{_SCRIPT}<ambient>1 0 0 1</ambient></material>  <!-- ^ SDF015 -->"),
    _visual(f"<material>{_SCRIPT.replace('Red', 'Black')}</material>  <!-- ^ SDF015 -->"),
    _visual("<material/>  <!-- ^ SDF015 -->"),
    {
        "@profile": "gazebo-classic",
        "@fragment": _visual(
            "<material><script>\n"
            "<uri>/home/ann/models/tag/materials/scripts</uri>  <!-- ^ SDF015 -->\n"
            "<name>Tag</name></script></material>"
        ),
    },
]
