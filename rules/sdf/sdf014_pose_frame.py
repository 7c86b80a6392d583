"""A pose with the attribute `frame`.

Gazebo 9 never read it, and since SDF 1.7 `relative_to` replaces it. libsdformat from Gazebo 11 and
Dome on converts it to `relative_to` in files before SDF 1.7, so that the part is in another place
than in Gazebo 9; in newer files it has no effect. An empty attribute has no effect in any file.
SDF017 reports a frame that does not exist.

Fix: remove the attribute, and write the pose relative to the element around it.
Source: SDFormat specification, pose 1.5 to 1.7; how libsdformat 12 reads it. The Model Migration
Guide's own example still has the empty attribute that Gazebo 9's converter wrote.
"""

from checker.formats.sdf.document import SdfDocument, sdf_version
from checker.formats.sdf.frame_faults import world_frame_faults
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule


@rule("SDF014", "pose-frame", Severity.WARNING, Concern.PORTABILITY)
def check(sdf: SdfDocument) -> Findings:
    """Report the attribute, empty or not."""
    read = sdf_version(sdf.document) < (1, 7)
    effect = "which Gazebo 9 ignores, and later ones read" if read else "which has no effect"
    unknown = {fault.span.start for fault in world_frame_faults(sdf.document)}
    for element in sdf.elements():
        frame = element.attribute("frame") if element.tag == "pose" else None
        if frame is None or frame.span.start in unknown:
            continue
        if frame.value:
            yield finding(
                frame,
                f"the pose names the frame {frame.value!r} in the attribute `frame`, {effect}",
            )
        else:
            yield finding(
                element.attribute_name_span("frame"),
                "the pose has an empty attribute `frame`, which has no effect",
                severity=Severity.INFO,
                # Beside `relative_to` it does have one.
                fix=None
                if element.get("relative_to")
                else replace_text(element.whole_attribute_span("frame"), ""),
            )


GOOD = ['<link name="arm"><pose>0 0 1 0 0 0</pose></link>']
BAD = [
    '<link name="arm"><pose frame="base_link">0 0 1 0 0 0</pose></link>  <!-- ^ SDF014 -->',
    "<link name='arm'><pose frame=''>0 0 1 0 0 0</pose></link>  <!-- ^ SDF014 -->",
]
