"""A pose with the attribute `frame`.

Gazebo 9 never read it. Newer parsers read it as `relative_to`, which replaces it since SDF 1.7. So
the part stands elsewhere in the one than in the other; an empty attribute has no effect. SDF017
and KIN010 report frames that do not exist.

Fix: remove the attribute, and write the pose relative to the element around it.
Source: SDFormat specification, pose 1.5 to 1.7. The Model Migration Guide's own example still has
the empty attribute that Gazebo 9's converter wrote.
"""

from checker.model.sdf.document import SdfDocument
from checker.model.sdf.frame_faults import world_frame_faults
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule


@rule("SDF014", "pose-frame", Severity.WARNING, Concern.PORTABILITY)
def check(sdf: SdfDocument) -> Findings:
    """Report the attribute, empty or not."""
    unknown = {fault.span.start for fault in world_frame_faults(sdf.document)}
    for element in sdf.elements():
        frame = element.attribute("frame") if element.tag == "pose" else None
        if frame is None or frame.span.start in unknown:
            continue
        if frame.value:
            yield finding(
                frame,
                f"the pose names the frame {frame.value!r} by the attribute `frame`, which Gazebo "
                "9 ignores: write relative_to",
            )
        else:
            yield finding(
                element.attribute_name_span("frame"),
                "the pose has an empty attribute `frame`, which has no effect",
                severity=Severity.INFO,
                fix=replace_text(element.whole_attribute_span("frame"), ""),
            )


GOOD = ['<link name="arm"><pose>0 0 1 0 0 0</pose></link>']
BAD = [
    '<link name="arm"><pose frame="base_link">0 0 1 0 0 0</pose></link>  <!-- ^ SDF014 -->',
    "<link name='arm'><pose frame=''>0 0 1 0 0 0</pose></link>  <!-- ^ SDF014 -->",
]
