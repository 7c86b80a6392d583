"""WheelSlip on a robot that steers its wheels or walks.

Steered wheels roll where they point, and feet must grip: with slip the robot drifts off its path.
Usually the plugin is left over from the skid-steer robot that the package was copied from. No
accepted package that we checked has this fault.

Fix: remove the WheelSlip plugin.
Source: SubT review practice: WheelSlip lets skid-steer wheels slip sideways in a turn.
"""

from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("DRV008", "needless-wheel-slip", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report WheelSlip plugins on Ackermann and legged robots."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    moves = robot.locomotion
    steered = any(drive.plugin.class_name == "AckermannSteering" for drive in moves.wheel_drives)
    if not steered and moves.kind is not DriveKind.LEGGED:
        return
    kind = DriveKind.ACKERMANN if steered else DriveKind.LEGGED
    for plugin in robot.all_plugins:
        if plugin.class_name == "WheelSlip":
            yield finding(
                plugin, f"the robot moves by {kind}, so nothing has to slip: remove WheelSlip"
            )


_SLIP = '<plugin filename="libw.so" name="ignition::gazebo::systems::WheelSlip"/>'
_MARK = "  <!-- ^ DRV008 -->"


def _robot(drive: str, slip: str = _SLIP) -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::{drive}"/>
{slip}
"""


GOOD = [_robot("DiffDrive"), _robot("AckermannSteering", "")]
BAD = [
    _robot("AckermannSteering", f"{_SLIP}{_MARK}"),
    """
<link name="shank"/>
<joint name="knee" type="revolute"><parent>base_link</parent><child>shank</child></joint>
<plugin filename="libp.so" name="cerberus_gazebo::AnymalControlPlugin"><joint>knee</joint></plugin>
<plugin filename="libw.so" name="gz::sim::systems::WheelSlip"/>  <!-- ^ DRV008 -->
""",
]
