"""A world or model refers to a frame that does not exist.

The place of the model or frame is undefined, so parsers refuse the file. KIN010 reports frames
inside a model. No accepted package that we checked has this fault.

Fix: name a frame or model of the same world; remove `relative_to` from the pose of a model outside
a world; let `placement_frame` name a frame of the model.
Source: SDFormat specification 1.7, "Pose frame semantics", and 1.8, model/@placement_frame.
"""

from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.frame_faults import world_frame_faults
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("SDF017", "unknown-frame-of-world", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument) -> Findings:
    """Report unknown frames, and frames that refer to each other in a circle."""
    for fault in world_frame_faults(sdf.document):
        yield finding(fault.span, fault.message)


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
