"""The battery plugin comes before the plugins that move the robot.

Gazebo runs plugins in the order in which they are listed. A battery plugin in front of the drive
plugins looks for joint commands before there are any, and may never start to drain. Reviewers ask
for the battery last.

Fix: move the LinearBatteryPlugin after the last drive, track or rotor plugin.
Source: SubT maintainers require "the battery plugin last" in their reviews.
"""

from checker.model.battery import BATTERY_CLASS, MOVING_CLASSES
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

NOTED = 6
"""Greatest number of plugins that a finding lists; a robot has up to that many rotors."""


@rule("BAT002", "battery-before-drive", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report batteries that a plugin of a wheel, track or rotor follows in the same file."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for index, battery in enumerate(robot.plugins):
        if battery.class_name != BATTERY_CLASS:
            continue
        behind = [
            plugin
            for plugin in robot.plugins[index + 1 :]
            if plugin.class_name in MOVING_CLASSES
            and plugin.element.document is battery.element.document
        ]
        if behind:
            yield finding(
                battery,
                f"the battery comes before {behind[0].class_name}: move it after all plugins that "
                "move the robot",
                related=[(drive, f"{drive.class_name} comes later") for drive in behind[:NOTED]],
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
