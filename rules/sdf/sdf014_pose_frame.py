"""A pose with the attribute `frame`.

Gazebo with SDF 1.5 and 1.6 never read it, and since SDF 1.7 `relative_to` replaces it. So a named
frame is ignored, or refused by a newer parser; an empty one has no effect.

Fix: remove the attribute, and write the pose relative to the element around it.
Source: SDFormat specification, pose 1.5 to 1.7. The Model Migration Guide's own example still has
the empty attribute that Gazebo 9's converter wrote.
"""

from checker.model.sdf.document import SdfDocument
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule


@rule("SDF014", "pose-frame", Severity.WARNING, Concern.PORTABILITY)
def check(sdf: SdfDocument) -> Findings:
    """Report the attribute, empty or not."""
    for element in sdf.elements():
        frame = element.attribute("frame") if element.tag == "pose" else None
        if frame is None:
            continue
        if frame.value:
            yield finding(
                frame,
                f"the pose names the frame {frame.value!r}, but the target ignores the attribute "
                "`frame`",
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
