"""Which sensor types of SDF stand for a kind of sensor that words name."""

from __future__ import annotations

from checker.model.specification.sensor_kinds import SensorKind

_LIDARS = frozenset({"gpu_lidar", "gpu_ray", "lidar", "ray"})
_DEPTH = frozenset({"rgbd_camera", "rgbd", "depth_camera", "depth"})
_CAMERAS = frozenset({"camera", "wideanglecamera", "wide_angle_camera"})

TYPES = {
    SensorKind.LIDAR: _LIDARS,
    SensorKind.PLANAR_LIDAR: _LIDARS,
    SensorKind.POINT_LIDAR: _LIDARS,
    SensorKind.CAMERA: _CAMERAS,
    SensorKind.DEPTH_CAMERA: _DEPTH,
    SensorKind.RGBD_CAMERA: _DEPTH,
    SensorKind.THERMAL_CAMERA: frozenset({"thermal", "thermal_camera"}),
    SensorKind.IMU: frozenset({"imu"}),
    SensorKind.MAGNETOMETER: frozenset({"magnetometer"}),
    SensorKind.AIR_PRESSURE: frozenset({"air_pressure"}),
    SensorKind.ALTIMETER: frozenset({"altimeter"}),
    SensorKind.GPS: frozenset({"gps", "navsat"}),
}
"""Types that stand for a kind; kinds that plugins may stand for are left out."""

SUBSTITUTES = {SensorKind.CAMERA: _DEPTH, SensorKind.DEPTH_CAMERA: _CAMERAS}
"""Types that words may mean as well: a camera that also measures depth."""
