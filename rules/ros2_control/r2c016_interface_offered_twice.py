"""A command interface of a joint that two tags of ros2_control offer.

The controller manager has one command interface `elbow/position`. Up to Humble, it logs "command
interface already in available list" for the second one, whose hardware never gets a command; later
releases refuse to load that hardware. Where the second one is a mock, this is a warning: MoveIt
Setup Assistant adds such a tag to robots that have another, which moves the joint. R2C005 reports
hardware of Gazebo that ros2_control_node gets, with which none of them is loaded.

Fix: remove the joint's `<command_interface>` from one of the tags, or put each tag below an
`xacro:if`, so that one of them is left.
Source: ros2_control, hardware_interface/src/resource_manager.cpp, where it imports command
interfaces.
"""

from checker.base.words import and_list
from checker.ros.ros2_control.distributions import distribution_of, is_from, is_mock, is_of_gazebo
from checker.ros.ros2_control.hardware import Hardware, HardwareJoint
from checker.ros.ros2_control.robot_control import RobotControl
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.rulebook.example_parts import GAZEBO, SHOULDER, ros2_control


@rule("R2C016", "interface-offered-twice", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl, context: Context, spawned: SpawnedFiles) -> Findings:
    """Report joints with the same command interface in two `<ros2_control>` tags."""
    simulated = any(is_of_gazebo(it.plugin.value) for it in control.hardware)
    if simulated and control.by_default and [*spawned.managers_outside(control.robot)]:
        return
    lost = "is not loaded" if is_from(distribution_of(context), "iron") else "does not move"
    first: dict[str, tuple[Hardware, HardwareJoint]] = {}
    for hardware in control.hardware:
        for joint in hardware.joints:
            before, its_joint = first.setdefault(joint.name.value, (hardware, joint))
            offered = {command.name.value for command in its_joint.commands}
            twice = [it.name.value for it in joint.commands if it.name.value in offered]
            # Two tags of one name: R2C003.
            if before.name.value != hardware.name.value and twice:
                keys = and_list([f"{joint.name.value}/{name}" for name in dict.fromkeys(twice)])
                yield finding(
                    joint,
                    f"{keys} is offered by <ros2_control> {before.name.value!r} and "
                    f"{hardware.name.value!r}: the hardware of {hardware.name.value!r} {lost}; "
                    "remove the <command_interface> from one",
                    severity=Severity.WARNING if is_mock(hardware.plugin.value) else None,
                    key=f"{before.name.value} {hardware.name.value}",
                    related=[(its_joint, "the first one")],
                )


def _second(inside: str) -> object:
    other = f'<ros2_control name="simulator" type="system"><hardware>{GAZEBO}</hardware>'
    return {"@urdf": ros2_control() + f"{other}\n{inside}\n</ros2_control>"}


GOOD = [
    _second('<joint name="shoulder"><state_interface name="position"/></joint>'),
    {"@urdf": ros2_control() + ros2_control()},
]
BAD = [_second(f"{SHOULDER}  <!-- ^ R2C016 -->")]
