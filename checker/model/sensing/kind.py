"""Kinds of sensors: what the type of a `<sensor>` means, whichever release spells it."""

from __future__ import annotations

import enum
from functools import cache

from checker.resources import table


class SensorType(enum.StrEnum):
    """What a `<sensor>` is. A member's value is its type's newest spelling in SDFormat."""

    CAMERA = "camera"
    WIDE_ANGLE_CAMERA = "wide_angle_camera"
    DEPTH_CAMERA = "depth_camera"
    RGBD_CAMERA = "rgbd_camera"
    THERMAL_CAMERA = "thermal_camera"
    LOGICAL_CAMERA = "logical_camera"
    GPU_LIDAR = "gpu_lidar"
    CPU_LIDAR = "lidar"
    IMU = "imu"
    MAGNETOMETER = "magnetometer"
    AIR_PRESSURE = "air_pressure"
    ALTIMETER = "altimeter"
    CONTACT = "contact"
    OTHER = "other"

    @property
    def takes_pictures(self) -> bool:
        """Whether it renders pictures of pixels, as described by a `<camera>`."""
        return self in _PICTURES

    @property
    def sees_colours(self) -> bool:
        """Whether it gives a colour picture."""
        return self in (SensorType.CAMERA, SensorType.WIDE_ANGLE_CAMERA, SensorType.RGBD_CAMERA)

    @property
    def measures_depth(self) -> bool:
        """Whether it gives a picture of distances."""
        return self in (SensorType.DEPTH_CAMERA, SensorType.RGBD_CAMERA)

    @property
    def is_lidar(self) -> bool:
        """Whether it measures ranges along rays."""
        return self in (SensorType.GPU_LIDAR, SensorType.CPU_LIDAR)


_PICTURES = frozenset(
    {
        SensorType.CAMERA,
        SensorType.WIDE_ANGLE_CAMERA,
        SensorType.DEPTH_CAMERA,
        SensorType.RGBD_CAMERA,
        SensorType.THERMAL_CAMERA,
    }
)


def sensor_type(text: str) -> SensorType:
    """Return what a sensor's type means; `OTHER` for one that is unknown or of no concern."""
    return _types().get(text, SensorType.OTHER)


@cache
def _types() -> dict[str, SensorType]:
    members = {member.value: member for member in SensorType}
    releases = table("gazebo_sensors")["releases"].values()
    return {
        spelling: members[entry["type"]]
        for release in releases
        for entry in release["types"]
        for spelling in entry["spellings"]
        if entry["type"] in members
    }
