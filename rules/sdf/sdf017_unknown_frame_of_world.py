"""A world or model refers to a frame that does not exist.

The place of the model or frame is undefined, so parsers refuse the file. KIN010 reports frames
inside a model. No accepted package that we checked has this fault.

Fix: name a frame or model of the same world; remove `relative_to` from the pose of a model outside
a world; let `placement_frame` name a frame of the model.
Source: SDFormat specification 1.7, "Pose frame semantics", and 1.8, model/@placement_frame.
"""

from checker.finding import Fix, Safety
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.frame_faults import world_frame_faults
from checker.model.faults import Fault
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.xml import Element


@rule("SDF017", "unknown-frame-of-world", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument) -> Findings:
    """Report unknown frames, and frames that refer to each other in a circle."""
    for fault in world_frame_faults(sdf.document):
        yield finding(fault.span, fault.message, fix=_without_frame(fault))


def _without_frame(fault: Fault) -> Fix | None:
    """Return the fix that takes the frame from the pose of an outermost model."""
    pose = fault.span.holder
    if not isinstance(pose, Element) or pose.path.count("/") != 2 or pose.tag != "pose":
        return None
    names = (name for name in pose.attributes if name in ("frame", "relative_to"))
    spans = (pose.whole_attribute_span(name) for name in names)
    return Fix(Safety.UNSAFE, tuple(span.replacement("") for span in spans))


def _world(content: str) -> str:
    return f"""
<sdf version="1.8">
  <world name="hall">
    <frame name="corner"/>
    <model name="box">
      <pose relative_to="corner">0 0 0 0 0 0</pose>
      <link name="body"/>
    </model>
    {content}
  </world>
</sdf>
"""


GOOD = [
    _world('<frame name="lid" attached_to="box::body"/>'),
    _world('<include><uri>model://x</uri></include><frame name="lid" attached_to="x::y"/>'),
]
BAD = [
    _world('<frame name="lid" attached_to="crate"/>  <!-- ^ SDF017 -->'),
    _world('<frame name="lid" attached_to="box::lid"/>  <!-- ^ SDF017 -->'),
    _world('<frame name="a" attached_to="a"/>  <!-- ^ SDF017 -->'),
    """
<sdf version="1.8">
  <model name="table" placement_frame="top">  <!-- ^ SDF017 -->
    <pose relative_to="floor">0 0 0 0 0 0</pose>  <!-- ^ SDF017 -->
    <link name="board"/>
  </model>
</sdf>
""",
]
