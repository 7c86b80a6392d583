"""A robot without an IMU.

Every robot of the SubT challenge has an IMU: localisation of the robot starts from it.

Fix: add a sensor of type `imu` to the link that carries the real IMU, with the noise of the SubT
standard (SEN013).
Source: SubT model reviews; every accepted robot has an IMU.
"""

from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_ROBOTS = (PackageKind.ROBOT, PackageKind.CONFIGURATION)


@rule("SEN022", "no-imu", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, robot: Robot) -> Findings:
    """Report robots without an IMU; packages for others to build on need none."""
    if package.kind not in _ROBOTS or any(s.kind is SensorType.IMU for s in robot.sensors):
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    yield finding(robot, f"robot {robot.name.value!r} has no IMU; add a sensor of type imu")


_MODEL = """
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">  {mark}
<link name="base_link">{sensor}</link>
</model>
</sdf>
"""

GOOD = [
    _MODEL.format(mark="", sensor='<sensor name="imu_sensor" type="imu"/>'),
    {"@name": "acme_rover_base", "launch/spawner.rb": None, "launch/vehicle_topics.launch": None},
]
BAD = [_MODEL.format(mark="<!-- ^ SEN022 -->", sensor='<sensor name="imu" type="magnetometer"/>')]
