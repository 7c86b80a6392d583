"""Settings of an inertial measurement unit."""

from __future__ import annotations

from collections.abc import Mapping

from checker.base.record import Record
from checker.model.sensing.noise import Noise, read_noise
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element, Tagged

QUANTITIES = ("angular_velocity", "linear_acceleration")


class Imu(Tagged, Record, eq=False):
    """An `<imu>`.

    Attributes:
        noises: The noise by quantity and axis, `("angular_velocity", "x")`: rad/s and m/s².
        enable_orientation: Whether it gives its true orientation; SDFormat's default is yes.
        element: The `<imu>`.
    """

    noises: Mapping[tuple[str, str], Noise]
    enable_orientation: Located[bool]
    element: Element


def read_imu(sensor: Element) -> Imu | None:
    """Read the `<imu>` of a sensor; None if it has none."""
    element = sensor.child("imu")
    if element is None:
        return None
    return Imu(
        _noises(element), ValueReader().boolean(element, "enable_orientation", True), element
    )


def _noises(imu: Element) -> dict[tuple[str, str], Noise]:
    noises = {}
    for quantity in QUANTITIES:
        holder = imu.child(quantity)
        for axis in "xyz":
            noise = read_noise(holder.child(axis)) if holder is not None else None
            if noise is not None:
                noises[quantity, axis] = noise
    return noises
