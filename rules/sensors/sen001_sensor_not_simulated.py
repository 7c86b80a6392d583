"""A sensor of a type that does not exist or that the target does not simulate.

The sensor publishes nothing, and Gazebo prints no message: the robot drives without the satellite
receiver or the sonar that its specification sheet lists. With a type that SDFormat does not know,
the file does not load.

Fix: use a type that the target simulates, or remove the sensor and say so in specifications.md.
Source: types that SDFormat reads, and systems that simulate them, per release
(`gazebo_sensors.json`).
"""

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.model.robot import Robot
from checker.model.sensing.kind import sensor_types
from checker.rule import Concern, Context, Findings, Severity, finding, misspelt, rule

_IN_CLASSIC = table("gazebo_classic_ros2")["sensors_instead"]
"""Replacements in Gazebo Classic of types that only later releases simulate."""


@rule("SEN001", "sensor-not-simulated", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, context: Context) -> Findings:
    """Report types of sensors that are unknown or not simulated by the target release."""
    types = sensor_types(context.release)
    target = f"Gazebo {context.release.capitalize()}" if context.release else "SDFormat"
    suggestions = Suggestions(sorted(types.known - types.lost))
    for sensor in robot.sensors:
        type = sensor.type.value
        message = f"sensor {sensor.name.value!r} has the type {type!r}"
        if not sensor.type.stated:
            continue  # the required attribute is for SDF005
        if type not in types.known:
            message = f"{message}, which {target} does not know"
            yield misspelt(sensor.type, message, suggestions, key=f"unknown {type}")
        elif type in types.lost:
            instead = _IN_CLASSIC.get(type) if context.is_classic else None
            hint = f": expected {instead!r}" if instead else ""
            yield finding(
                sensor.type,
                f"{message}, which {target} does not simulate{hint}",
                key=f"lost {type}",
            )


def _sensor(type: str) -> str:
    return f'<sensor name="s" type="{type}"/>'


_MARK = "  <!-- ^ SEN001 -->"
_CLASSIC = {"@profile": "gazebo-classic"}
GOOD = [
    *map(_sensor, ("camera", "gpu_lidar", "imu", "thermal", "rgbd", "logical_camera", "contact")),
    _sensor("ray"),
    *({**_CLASSIC, "@fragment": _sensor(type)} for type in ("ray", "gps", "sonar", "depth")),
]
BAD = [
    *(_sensor(type) + _MARK for type in ("gps", "sonar", "wireless_receiver", "gpu_lida", "")),
    *({**_CLASSIC, "@fragment": _sensor(type) + _MARK} for type in ("gpu_lidar", "navsat")),
]
