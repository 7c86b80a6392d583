"""A joint that mimics another, in a release that does not support mimic joints.

Gazebo converts `<mimic>` from Harmonic on. Fortress drops it: the second finger of a gripper swings
freely, or needs its own controller. Mimic joints of ros2_control are not affected: its plugin moves
both joints.

Fix: command both joints, or let ros2_control do so; or use Harmonic or later.
Source: sdformat, parser_urdf.cc of sdf12 and sdf14; tried with libsdformat 12.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_LOSING = ("fortress",)


@rule("URD019", "mimic-not-simulated", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report joints that mimic others, where neither Gazebo nor a plugin moves them."""
    if context.release not in _LOSING or not robot.is_for_gazebo:
        return
    controlled = {
        joint.get("name")
        for control in robot.element.all("ros2_control")
        for joint in control.all("joint")
    }
    for joint in robot.joints:
        if joint.scoped_name in robot.driven_joints or joint.name.value in controlled:
            continue
        for leader in joint.mimics:
            yield finding(
                leader,
                f"joint {joint.name.value!r} moves freely instead of following {leader.value!r}: "
                f"Gazebo {context.release.capitalize()} does not support <mimic>",
                key="mimic",
            )


def _gripper(profile: str, mark: str = "", gazebo: str = "<gazebo/>") -> dict[str, object]:
    text = f"""<robot name="gripper">
<link name="base_link"/>
<link name="left"/>
<link name="right"/>
<joint name="left_joint" type="continuous">
  <parent link="base_link"/><child link="left"/>
</joint>
<joint name="right_joint" type="continuous">
  <parent link="base_link"/><child link="right"/>
  <mimic joint="left_joint"/>{mark}
</joint>
{gazebo}
</robot>
"""
    return {"@urdf": True, "@profile": profile, "urdf/arm.urdf": text}


GOOD = [
    _gripper("gazebo-harmonic"),
    _gripper("gazebo-fortress", gazebo=""),
]
BAD = [_gripper("gazebo-fortress", "  <!-- ^ URD019 -->")]
