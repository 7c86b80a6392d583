"""The battery stands before the plugins that move the robot.

Plugins take their turns in the order in which they stand: a battery in front of the drives looks
for commands to the joints before there are any, and may never begin to drain. Reviewers ask for it
behind them.

Fix: move the LinearBatteryPlugin behind the last drive, track or rotor plugin.
Source: SubT maintainers ask for "the battery plugin last" in their reviews.
"""

from checker.model.battery import BATTERY_CLASS, MOVING_CLASSES
from checker.model.robot import Robot
from checker.rule import Findings, Severity, finding, rule, unchecked

NOTED = 6
"""Plugins that a finding names; a robot has up to that many rotors."""


@rule("BAT002", "battery-before-drive", Severity.WARNING)
def check(robot: Robot) -> Findings:
    """Report batteries with a plugin of a wheel, track or rotor behind them in the same file."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for index, battery in enumerate(robot.plugins):
        if battery.class_name != BATTERY_CLASS:
            continue
        behind = [
            each
            for each in robot.plugins[index + 1 :]
            if each.class_name in MOVING_CLASSES
            and each.element.document is battery.element.document
        ]
        if behind:
            yield finding(
                battery,
                f"the battery stands before {behind[0].class_name}: expected it behind all "
                "plugins that move the robot",
                related=[(each, f"{each.class_name} comes later") for each in behind[:NOTED]],
            )


def _plugin(name: str, mark: str = "") -> str:
    return f'<plugin filename="libp.so" name="ignition::gazebo::systems::{name}"/>{mark}\n'


_MARK = " <!-- ^ BAT002 -->"

GOOD = [
    _plugin("DiffDrive") + _plugin("LinearBatteryPlugin") + _plugin("WheelSlip"),
    _plugin("LinearBatteryPlugin") + _plugin("JointStatePublisher"),
]
BAD = [
    _plugin("LinearBatteryPlugin", _MARK) + _plugin("DiffDrive"),
    _plugin("DiffDrive")
    + _plugin("LinearBatteryPlugin", _MARK)
    + _plugin("TrackController")
    + _plugin("MulticopterMotorModel"),
]
