"""A pose or axis relative to a frame that does not exist, or to itself.

The pose of the part is undefined: parsers refuse the model, or put the part at the origin.

No accepted package that we checked has this fault.

Fix: write the exact name of a link, joint or frame of the same model, and do not define the poses
of two frames relative to each other.
Source: SDFormat specification 1.7, "Pose frame semantics"; SDF 1.5 and 1.6, pose/@frame.
"""

from checker.model.faults import FaultKind
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("KIN010", "unknown-frame", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report unknown frames, and frames that refer to each other in a circle."""
    if not robot.conventions.has_frames:
        return
    known = robot.frame_graph.nodes
    by_default = {
        id(joint.pose.span)
        for joint in robot.joints
        if not joint.pose.relative_to and joint.scope + joint.child.value not in known
    }
    for fault in robot.faults_of(FaultKind.FRAME):
        # A joint stands at its child unless it says otherwise; an unknown child is KIN001's.
        if id(fault.span) in by_default:
            continue
        if robot.may_be_included(fault.message):
            yield unchecked(robot.missing_parts)
        else:
            yield finding(fault.span, fault.message)


def _sdf(version: str, content: str) -> str:
    return f"""
<sdf version="{version}">
<model name="acme_rover_sensor_config_1">
<link name="base_link"/>
{content}
</model>
</sdf>
"""


GOOD = [
    '<link name="mast"><pose frame="base_link">0 0 1 0 0 0</pose></link>',
    _sdf(
        "1.7",
        '<frame name="top" attached_to="base_link"/>\n'
        '<link name="mast"><pose relative_to="top">0 0 1 0 0 0</pose></link>',
    ),
    """
<link name="wheel"/>
<joint name="axle" type="fixed"><parent>base_link</parent><child>weel</child></joint>
""",
]
BAD = [
    _sdf(
        "1.7",
        '<link name="mast"><pose relative_to="top">0 0 1 0 0 0</pose></link>  <!-- ^ KIN010 -->',
    ),
    _sdf("1.8", '<frame name="top" attached_to="roof"/>  <!-- ^ KIN010 -->'),
    _sdf(
        "1.7",
        '<frame name="a" attached_to="b"/>  <!-- ^ KIN010 -->\n<frame name="b" attached_to="a"/>',
    ),
    _sdf(
        "1.7",
        '<frame name="a" attached_to="roof">  <!-- ^ KIN010 -->\n'
        '<pose relative_to="base_link">0 0 1 0 0 0</pose></frame>',
    ),
]
