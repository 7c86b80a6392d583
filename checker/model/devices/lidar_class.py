"""Lidars by the shape of their scan: a volume, a plane, a point."""

from __future__ import annotations

import enum

from checker.model.components import Sensor
from checker.model.devices.devices import Device
from checker.model.specification.sensor_kinds import SensorKind

POINT_RAYS = 9
"""Rays at most of a lidar that measures one distance; some spread 3 × 3 over their beam."""


class LidarClass(enum.Enum):
    """Class of a lidar by its kind of scan; the value is the kind of such devices."""

    VOLUME = "lidar3d"
    PLANE = "lidar2d"
    POINT = "lidar1d"


_KINDS = {
    SensorKind.LIDAR: LidarClass.VOLUME,
    SensorKind.PLANAR_LIDAR: LidarClass.PLANE,
    SensorKind.POINT_LIDAR: LidarClass.POINT,
}


def class_of_device(device: Device) -> LidarClass | None:
    """Return how a device scans; None if it is no lidar."""
    return next((kind for kind in LidarClass if kind.value == device.kind), None)


def class_of_kind(kind: SensorKind) -> LidarClass | None:
    """Return how the kind of lidar scans that words mean; None for other sensors."""
    return _KINDS.get(kind)


def class_of_sensor(sensor: Sensor) -> LidarClass | None:
    """Return how a sensor is set to scan; None for others than lidars."""
    lidar = sensor.lidar
    if lidar is None or not sensor.kind.is_lidar:
        return None
    if lidar.rays <= POINT_RAYS:
        return LidarClass.POINT
    return LidarClass.PLANE if lidar.rows <= 1 else LidarClass.VOLUME
