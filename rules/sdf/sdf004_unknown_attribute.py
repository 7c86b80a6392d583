"""An attribute that the element does not have.

Parsers skip unknown attributes, so they have no effect: a misspelt `relative_to` leaves a part in
the wrong place. libsdformat reads a file of an older version as one of its own newest version, so
attributes of that version have an effect in any file. SDF014 reports the attribute `frame` of a
pose. Attributes with a namespace prefix are ignored. No accepted package that we checked has this
fault.

Fix: spell it as the specification does, or remove it.
Source: SDFormat specification, the version that the file states.
"""

from checker.base.words import Suggestions
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.schema import type_of
from checker.rule import Concern, Context, Findings, Severity, finding, replace_text, rule

ELSEWHERE = {("pose", "frame")}
"""Attributes, with their elements, that another rule judges."""


@rule("SDF004", "unknown-attribute", Severity.WARNING, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report attributes that this SDF version does not know at this element."""
    for element, kind in sdf.typed_as(context.reads):
        if kind is None:
            continue
        known = kind.attributes
        for name in element.attributes:
            if name in known or ":" in name or (element.tag, name) in ELSEWHERE:
                continue
            later = type_of(element, context.reads)
            if later is not None and name in later.attributes:
                continue
            suggestions = Suggestions(known)
            sure = suggestions.correction(name)
            place = element.attribute_name_span(name)
            yield finding(
                place,
                f"<{element.tag}> has no attribute {name!r} in SDF {kind.version}"
                f"{suggestions.hint(name)}",
                key=f"{element.tag}/{name}",
                fix=replace_text(place, sure) if sure and sure not in element.attributes else None,
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
