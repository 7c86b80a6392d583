"""A URDF that another reader does not read, or reads differently.

Tools read URDF with different libraries. yourdfpy is one that many Python programs use. Where it
cannot read a robot, or finds other links, masses or places than ROS and Gazebo, the file contains
something that the readers of URDF do not agree about.

This rule runs with `--thorough`.

Fix: write what the message names in the usual way: each element once, with its attributes, and
nothing that the URDF specification does not have.
Source: yourdfpy.
"""

from checker.formats.urdf.second_reading import SecondReading
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD030", "readers-disagree", Severity.WARNING, Concern.PORTABILITY)
def check(reading: SecondReading) -> Findings:
    """Report what yourdfpy does not read as our reader does."""
    robot = reading.robot
    ends = (end.value for joint in robot.joints for end in (joint.parent, joint.child))
    # KIN001 reports joints of links that do not exist.
    if reading.error and all(end in robot.links_by_name for end in ends):
        yield finding(robot, f"yourdfpy cannot read the robot: {reading.error}", key="cannot read")
    for difference in reading.differences:
        it = difference.part
        kind = "" if isinstance(it, Robot) else f"{type(it).__name__.lower()} {it.name.value!r}: "
        yield finding(it, f"{kind}yourdfpy {difference.words}", key=difference.words)


def _hand(inertial: str, mark: str = "") -> dict[str, str]:
    return {
        "@urdf": f"""<link name="hand">{mark}
<inertial>{inertial}</inertial>
</link>
<joint name="wrist" type="fixed">
  <parent link="upper_arm"/><child link="hand"/><origin xyz="0 0 0.1"/>
</joint>"""
    }


_MOMENTS = '<inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/>'
GOOD = [_hand(f'<mass value="0.4"/>{_MOMENTS}')]
BAD = [_hand(_MOMENTS, "  <!-- ^ URD030 -->")]
