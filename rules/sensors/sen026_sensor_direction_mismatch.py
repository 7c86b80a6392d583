"""A sensor does not look in the direction of its name.

A driver who relies on `camera_rear` but sees the front hits a wall, and a map from a rotated lidar
is rotated too. Usually a yaw is missing, or is in degrees.

Fix: turn the sensor's pose (a camera looks along its x axis, and the robot's x axis points
forward), or rename it after its direction.
Source: SDFormat specification, sensor/pose; REP 103 (x forward, y left, z up).
"""

import math

from checker.model.robot import Robot
from checker.model.sensing.mounts import called_directions, mounted_sensors
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("SEN026", "sensor-direction-mismatch", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    *,
    largest_angle: float = 60.0,
    largest_angle_tilted: float = 80.0,
    largest_angle_sideways: float = 120.0,
) -> Findings:
    """Compare the directions of sensors with their names.

    Options:
        largest_angle: Degrees that a sensor may look away from the direction in its name, for names
            with front or rear.
        largest_angle_tilted: Degrees that a sensor may look away from the direction in its name,
            for names with up or down and without front or rear; some are slightly tilted.
        largest_angle_sideways: Degrees that a sensor may look away from the direction in its name,
            for names with only left or right; some pairs look forward.
    """
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    for sensor in mounted_sensors(robot):
        looking = sensor.looking
        called = called_directions(sensor) if looking is not None else None
        if looking is None or called is None:
            continue
        angle = math.degrees(called.angle_to(looking))
        limit = largest_angle_tilted if called.tilted else largest_angle
        if called.sideways:
            limit = largest_angle_sideways
        if angle <= limit:
            continue
        x, y, z = (round(part, 2) + 0.0 for part in looking)
        yield finding(
            sensor.sensor,
            f"sensor {sensor.sensor.name.value!r} looks {angle:.0f}° away from the direction "
            f"{called.word!r} in its {called.source}: it looks along ({x:g}, {y:g}, {z:g}) in the "
            f"robot's frame; expected {limit:g}° or less",
        )


def _camera(name: str, pose: str, mark: str = "", link: str = "head") -> str:
    return f"""
<link name="{link}">
  <sensor name="{name}" type="camera">{mark}
    <pose>{pose}</pose>
  </sensor>
</link>
"""


def _laser(name: str, pose: str, angle: float, mark: str = "") -> str:
    return f"""
<sensor name="{name}" type="gpu_lidar">{mark}
  <pose>{pose}</pose>
  <lidar><scan><horizontal>
    <min_angle>{-angle}</min_angle>
    <max_angle>{angle}</max_angle>
  </horizontal></scan></lidar>
</sensor>
"""


_AHEAD, _BACK, _ASIDE = "0.2 0 0 0 0 0", "-0.2 0 0 0 0 3.14159", "0 0.2 0 0 0 1.5708"
_MARK = "  <!-- ^ SEN026 -->"
GOOD = [
    _camera("camera_front", "0.2 0 0 0 0.5 0"),
    _camera("rearCamera", _BACK),
    _camera("front_left_camera", _ASIDE),
    # The left one of two that look ahead.
    _camera("left", _AHEAD) + _camera("right", _AHEAD, link="neck"),
    _camera("camera_down", "0.2 0 0 0 0.4 0"),
    # Words within words, and links named for where they are.
    _camera("upper_copyright_camera", _BACK),
    _camera("camera", _BACK, link="front_left_wheel"),
    _camera("front_cliff", "0.2 0 0 0 1.5708 0"),
    # Sees to all sides, so that it may be turned.
    _laser("front_laser", "0.2 0 0 0 0 3.14159", 3.14159),
    '<sensor name="rear_imu" type="imu"/>',
]
BAD = [
    _camera("camera_front", _BACK, _MARK),
    _camera("camera_rear", _AHEAD, _MARK),
    _camera("left_camera", "0 -0.2 0 0 0 -1.5708", _MARK),
    _camera("cameraDown", "0 0 0 0 -1.5708 0", _MARK),
    _camera("camera_up", _AHEAD, _MARK),
    _camera("camera", _AHEAD, _MARK, link="rear_camera_link"),
    _laser("laser_rear", "-0.2 0 0 0 0 0", 1.0, _MARK),
]
