"""An attribute that the element does not have.

Parsers skip attributes that they do not know, so what one should have said is lost: a misspelt
`relative_to` leaves a part where nobody put it. The attribute `frame` of a pose is SDF014;
attributes with a namespace prefix belong to others.
No accepted package at hand shows it.

Fix: spell it as the specification does, or remove it.
Source: SDFormat specification, the version that the file states.
"""

from checker.base.words import Suggestions
from checker.model.sdf.document import SdfDocument
from checker.rule import Findings, Severity, finding, replace_text, rule

ELSEWHERE = {("pose", "frame")}
"""Attributes, with their elements, that another rule judges."""


@rule("SDF004", "unknown-attribute", Severity.WARNING)
def check(sdf: SdfDocument) -> Findings:
    """Report attributes that this SDF version does not know at this element."""
    for element, kind in sdf.typed_elements:
        if kind is None:
            continue
        known = kind.attributes
        for name in element.attributes:
            if name in known or ":" in name or (element.tag, name) in ELSEWHERE:
                continue
            near = Suggestions(known).near(name)
            place = element.attribute_name_span(name)
            hint = f"; did you mean {near!r}?" if near else ""
            yield finding(
                place,
                f"<{element.tag}> has no attribute {name!r} in SDF {kind.version}{hint}",
                key=f"{element.tag}/{name}",
                fix=replace_text(place, near) if near and near not in element.attributes else None,
            )


GOOD = ['<link name="arm"/>', '<link name="arm" note:by="me" xmlns:note="urn:note"/>']
BAD = [
    '<link name="arm" colour="red"/>  <!-- ^ SDF004 -->',
    """
<plugin
  name="ignition::gazebo::systems::PosePublisher"
  file_name="libignition-gazebo-pose-publisher-system.so"  ></plugin>  <!-- ^ SDF004 -->
""",
    '<visual nam="body"><geometry><sphere/></geometry></visual>  <!-- ^ SDF004 -->',
]
