"""Devices that have the shape of a lidar's scan: as many rows over the same angle."""

from __future__ import annotations

import math

from checker.model.devices.devices import Device
from checker.model.devices.known import KnownDevices
from checker.model.sensing.lidar import Lidar


def devices_of_shape(lidar: Lidar, known: KnownDevices, tolerance: float = 1.0) -> list[Device]:
    """Return the devices of several rows that scan as a lidar does.

    Args:
        lidar: As it is set.
        known: Devices of which one variant is known count.
        tolerance: Degrees.
    """
    lower, upper = vertical_degrees(lidar)
    return [
        device
        for device in known.devices
        if isinstance(device.values.get("rows"), int)
        and lidar.rows == device.values["rows"] > 1
        and "vfov_deg" in device.values
        and abs(lower - device.values["vfov_deg"][0]) <= tolerance
        and abs(upper - device.values["vfov_deg"][1]) <= tolerance
    ]


def vertical_degrees(lidar: Lidar) -> tuple[float, float]:
    """Return the angles of the lowest and the highest row, degrees."""
    return math.degrees(lidar.vertical.lower.value), math.degrees(lidar.vertical.upper.value)
