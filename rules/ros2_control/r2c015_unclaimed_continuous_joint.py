"""A joint that turns without end, and that ros2_control of Gazebo holds still.

For Gazebo a joint with a `<command_interface>` has a motor. Where no controller claims it, its
velocity is set to 0 in each step: a caster neither rolls nor swivels, and the robot drags it.

Fix: remove the `<command_interface>` of a joint without a motor; its `<state_interface>`s may stay.
Or write a controller for it.
Source: gz_ros2_control, gz_system.cpp, `write`: joints with command interfaces that no controller
claims get a velocity of zero; gazebo_ros2_control, pull requests 177 and 237.
"""

from collections import Counter
from collections.abc import Iterator

from checker.finding import Fix
from checker.package.package import Package
from checker.ros.ros2_control.distributions import is_of_gazebo
from checker.ros.ros2_control.hardware import HardwareJoint
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Findings, Safety, Severity, finding, rule, unchecked
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control
from checker.source.text import SourceText
from checker.source.xml_insertion import removal


@rule("R2C015", "unclaimed-continuous-joint", Severity.WARNING, Concern.ROBOT)
def check(control: RobotControl, package: Package) -> Findings:
    """Report continuous joints with a velocity command that files of parameters do not name.

    JointStateBroadcaster claims no joint that it names.
    """
    simulated = [it for it in control.hardware if is_of_gazebo(it.plugin.value)]
    if not simulated or not control.is_named:
        return
    yield from map(unchecked, control.unread)
    read = [package.read(file.path) for file in control.files]
    texts = [source.text if isinstance(source, SourceText) else "" for source in read]
    listened = Counter(_listened(control))
    for joint in (joint for hardware in simulated for joint in hardware.joints):
        known, name = control.joint(joint), joint.name.value
        endless = known is not None and known.type.value == "continuous"
        commands = [command.name.value for command in joint.commands]
        named = sum(text.count(name) for text in texts) > listened[name] or not all(texts)
        if endless and "velocity" in commands and not named and not control.unread:
            yield finding(
                joint.name,
                f"no controller claims joint {name!r}, and it has a <command_interface>: Gazebo "
                "holds it still; remove the <command_interface> if it has no motor",
                fix=_without_commands(joint),
            )


def _listened(control: RobotControl) -> Iterator[str]:
    for controller in control.controllers:
        if controller.class_name == "JointStateBroadcaster":
            for name in controller.own.intersection(("joints", "extra_joints")):
                yield from (joint.value for joint in controller.parameters[name].texts)


def _without_commands(joint: HardwareJoint) -> Fix:
    return Fix(Safety.UNSAFE, tuple(removal(command.element) for command in joint.commands))


_CASTER = """
<link name="ball"/>
<joint name="swivel" type="continuous">
  <parent link="upper_arm"/><child link="ball"/><axis xyz="0 1 0"/>
</joint>
"""
_PARAMETERS = "<parameters>$(find acme_arm_description)/config/arm.yaml</parameters>"


def _robot(
    interface: str, joints: str = "shoulder", mark: str = "", more: str = ""
) -> dict[str, str]:
    control = f"""<joint name="shoulder"><command_interface name="velocity"/></joint>
  <joint name="swivel">{mark}
    {interface}
    <state_interface name="position"/>
  </joint>"""
    return {
        "@urdf": _CASTER + ros2_control(control, GAZEBO) + gazebo_control(_PARAMETERS),
        "config/arm.yaml": f"""controller_manager:
  ros__parameters:
    arm_controller:
      type: forward_command_controller/ForwardCommandController
arm_controller:
  ros__parameters:
    interface_name: velocity
    joints: [{joints}]
{more}""",
    }


_VELOCITY = '<command_interface name="velocity"/>'
GOOD = [_robot(""), _robot(_VELOCITY, "shoulder, swivel")]
_MARK = "  <!-- ^ R2C015 -->"
_LISTENER = """listener:
  ros__parameters:
    type: joint_state_broadcaster/JointStateBroadcaster
    joints: [shoulder, swivel]
"""
BAD = [_robot(_VELOCITY, mark=_MARK), _robot(_VELOCITY, mark=_MARK, more=_LISTENER)]
