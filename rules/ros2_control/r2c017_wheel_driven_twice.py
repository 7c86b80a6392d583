"""A wheel that a drive plugin of Gazebo and ros2_control both move.

Each of them sets the velocity of the joint in every step, and the last one counts: the robot
stutters, stands still, or follows one topic and ignores the other. This happens where a robot is
changed from a drive plugin to ros2_control and keeps both.

Fix: remove the drive plugin, or the `<ros2_control>` tag with its plugin.
Source: gz-sim, `DiffDrive::PreUpdate`, and gz_ros2_control, `GazeboSimSystem::write`: both set
`JointVelocityCmd`.
"""

from checker.ros.ros2_control.distributions import is_of_gazebo
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import GAZEBO, ros2_control


@rule("R2C017", "wheel-driven-twice", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl) -> Findings:
    """Report drive plugins whose wheels have a command interface that Gazebo's plugin serves."""
    simulated = [it for it in control.hardware if is_of_gazebo(it.plugin.value)]
    joints = {it.name.value: it for each in simulated for it in each.joints if it.commands}
    for drive in control.robot.locomotion.drives if control.managers else ():
        names = [wheel.joint.name.value for wheel in drive.wheels]
        commanded = [joints[name] for name in names if name in joints]
        if commanded:
            yield finding(
                drive.plugin,
                f"{drive.plugin.label} drives joint {commanded[0].name.value!r}, which "
                f"{control.managers[0].plugin.label} moves too: remove one of them",
                key=drive.plugin.class_name,
                related=[(commanded[0].name, "the joint in <ros2_control>")],
            )


_WHEEL = """
<link name="wheel">
  <collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>
</link>
<joint name="axle" type="continuous">
  <parent link="base_link"/><child link="wheel"/><axis xyz="0 1 0"/>
</joint>
"""
_DRIVE = """
<gazebo>
  <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">@
    <left_joint>axle</left_joint>
  </plugin>
</gazebo>
"""
_MANAGER = """
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"/>
</gazebo>
"""


def _rover(joint: str, *parts: str) -> dict[str, str]:
    interface = f'<joint name="{joint}"><command_interface name="velocity"/></joint>'
    return {"@urdf": _WHEEL + ros2_control(interface, GAZEBO) + "".join(parts)}


GOOD = [
    _rover("axle", _MANAGER),
    _rover("shoulder", _MANAGER, _DRIVE.replace("@", "")),
    _rover("axle", _DRIVE.replace("@", "")),
]
BAD = [_rover("axle", _MANAGER, _DRIVE.replace("@", "  <!-- ^ R2C017 -->"))]
