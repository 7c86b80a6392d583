"""A required element or attribute that is missing or empty.

A required part has no default: the parser refuses the file, or builds an incomplete part. A part
without a name cannot be found. What is required depends on the version that the target's release
reads: the name of a plugin up to SDF 1.9, not from 1.10 on. A visual without geometry loads and
shows nothing, so that is a warning where the profile names no Gazebo release. Gazebo Classic
completes all but joints with defaults: for it a missing value is a warning. KIN001 reports the ends
of joints. No accepted package that we checked has this fault.

Fix: add the element or attribute that the message names.
Source: SDFormat specification, "Required: 1" at the element or attribute; libsdformat 9,
`readXml`.
"""

from collections.abc import Iterator

from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.schema import ElementType, walk
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.source.xml import Element

CHOICES = frozenset({"geometry"})
"""Required containers without defaults for their content; all others have defaults."""
ELSEWHERE = {("sdf", "version")}
"""Attributes, with their elements, that another rule judges."""
ENDS = ("parent", "child")
"""Children of a model's joint, which KIN001 reports."""


@rule("SDF005", "required-part-missing", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report required parts that are missing."""
    without = Severity.ERROR if context.release else Severity.WARNING
    if sdf.root.tag != "sdf":
        yield finding(sdf.root, f"the root element is <{sdf.root.tag}>, expected <sdf>")
    # The parser converts the file to the version that it reads, and copies what has no place there.
    version = context.reads if context.release else sdf.version
    for element, kind in walk(sdf.root, version, context.reads):
        if kind is not None:
            completed = context.release == "classic" and element.tag != "joint"
            valued = Severity.WARNING if completed else Severity.ERROR
            yield from _attributes(element, kind)
            yield from _children(element, kind, without, valued)


def _attributes(element: Element, kind: ElementType) -> Iterator[Finding]:
    for name, (_, _, required) in kind.attributes.items():
        stated = (element.get(name) or "").strip()
        if required == "1" and (element.tag, name) not in ELSEWHERE and not stated:
            state = "is empty" if name in element.attributes else "is missing"
            yield finding(
                element.attribute(name) or element,
                f"the attribute {name!r} of <{element.tag}> {state}",
                key=f"{element.tag}/@{name}",
            )


def _children(
    element: Element, kind: ElementType, without: Severity, valued: Severity
) -> Iterator[Finding]:
    """Report missing children: a geometry with the severity `without`, a value with `valued`."""
    ends = ENDS if element.parent is not None and element.parent.tag == "model" else ()
    for child in kind.required_children:
        name = child.name
        stated = element.all(name)
        if name in ends:
            stated = stated[1:]  # KIN001 looks at the first alone
        elif not stated and _has_to_be_stated(child):
            yield finding(
                element,
                f"{_element_label(element)} lacks <{name}>",
                severity=without if name in CHOICES else valued,
                key=f"{element.tag}/{name}",
            )
        for part in stated:
            if child.value_type and not part.text.stated:
                message = f"<{name}> of {_element_label(element)} is empty"
                yield finding(part, message, key=f"{element.tag}/{name} empty")


def _has_to_be_stated(child: ElementType) -> bool:
    return child.default is None if child.value_type else child.name in CHOICES


def _element_label(element: Element) -> str:
    name = element.get("name")
    return f"{element.tag} {name!r}" if name else f"<{element.tag}>"


_UNNAMED = """
<sdf version="1.9">
  <model name="rover">
    <link name="base_link"/>
    <plugin filename="libp.so"/>{}
  </model>
</sdf>
"""
GOOD = [
    '<visual name="body"><geometry><sphere><radius>1</radius></sphere></geometry></visual>',
    '<sensor name="s" type="camera"><camera/></sensor>',
    {
        # SDF 1.11, which Harmonic reads, has no <frame> in a joint: it is copied without a check.
        "@profile": "gazebo-harmonic",
        "@fragment": """
<joint name="j" type="fixed">
  <parent>world</parent>
  <child>base_link</child>
  <frame/>
</joint>
""",
    },
    # Harmonic reads it as SDF 1.11.
    {
        "@profile": "gazebo-harmonic",
        "model.sdf": _UNNAMED.format(""),
    },
]
BAD = [
    '<visual name="body"/>  <!-- ^ SDF005 -->',
    "<link/>  <!-- ^ SDF005 -->",
    '<sensor name="s" type=""/>  <!-- ^ SDF005 -->',
    """
<gripper name="claw">  <!-- ^ SDF005 -->
  <gripper_link>base_link</gripper_link>
</gripper>
""",
    {
        "@profile": "gazebo-fortress",
        "model.sdf": _UNNAMED.format("  <!-- ^ SDF005 -->"),
    },
    """
<visual name="body">
  <geometry>
    <mesh>
      <uri></uri>  <!-- ^ SDF005 -->
    </mesh>
  </geometry>
</visual>
""",
]
