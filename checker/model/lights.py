"""Attenuation of a light with distance, and the directions in which it shines."""

from __future__ import annotations

import math

from checker.base.record import Record
from checker.model.geometry.transform import Vector
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element, Tagged


class Attenuation(Tagged, Record, eq=False):
    """An `<attenuation>`: at distance d, light is divided by constant + linear·d + quadratic·d².

    Attributes:
        range: Metres up to which it shines.
        constant: Share of 1.
        linear: 1/m.
        quadratic: 1/m².
        element: The `<attenuation>`.
    """

    range: Located[float]
    constant: Located[float]
    linear: Located[float]
    quadratic: Located[float]
    element: Element

    @property
    def is_stated(self) -> bool:
        """True if the file states how the light weakens, and not only how far it shines."""
        return any(factor.stated for factor in (self.constant, self.linear, self.quadratic))

    def divisor(self, distance: float) -> float:
        """Return by what the light is divided at a distance, metres."""
        return (
            self.constant.value
            + self.linear.value * distance
            + self.quadratic.value * distance * distance
        )


def read_attenuation(light: Element) -> Attenuation | None:
    """Read the `<attenuation>` of a light; None if it has none. Defaults are SDFormat's."""
    element = light.child("attenuation")
    if element is None:
        return None
    values = ValueReader()
    return Attenuation(
        values.number(element, "range", 10.0),
        values.number(element, "constant", 1.0),
        values.number(element, "linear", 1.0),
        values.number(element, "quadratic", 0.0),
        element,
    )


_DOWN: Vector = (0.0, 0.0, -1.0)


class Beam(Record):
    """The cone of a spot light.

    Attributes:
        along: Its axis in the light's frame, of length 1.
        half: Radians from the axis to the edge.
    """

    along: Vector
    half: float


def read_beam(light: Element) -> Beam | None:
    """Read the cone of a `<light>`; None for one that shines all around, and without a cone."""
    spot = light.child("spot")
    if light.get("type") != "spot" or spot is None:
        return None
    values = ValueReader()
    x, y, z = (number.value for number in values.numbers(light, "direction", _DOWN))
    half = values.number(spot, "outer_angle", 0.0).value / 2.0
    length = math.hypot(x, y, z)
    if not (0.0 < length < math.inf and 0.0 < half < math.pi):
        return None
    return Beam((x / length, y / length, z / length), half)
