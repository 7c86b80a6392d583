"""Where a camera stands so that a picture shows all of something and little else."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from msgspec import to_builtins

from checker.base.record import Record

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

FIELD_OF_VIEW = 35.0
"""Degrees from the lower edge of a picture to the upper one: a portrait lens distorts little."""
_MARGIN = 1.12
"""What is shown may fill the picture but for this."""


class Camera(Record):
    """A camera as MuJoCo has it.

    Attributes:
        lookat: The middle of the picture, metres.
        distance: From there, metres.
        azimuth: Of the direction that it looks, degrees about z from x.
        elevation: Of that direction, degrees above the horizon.
    """

    lookat: tuple[float, float, float]
    distance: float
    azimuth: float
    elevation: float

    def as_json(self) -> dict[str, Any]:
        """Return its figures by name."""
        return to_builtins(self)


def framed(points: Array, azimuth: float, elevation: float, aspect: float) -> Camera:
    """Return the nearest camera of a direction that sees all points.

    Args:
        points: Metres (n × 3), at least one.
        azimuth: Degrees; see `Camera`.
        elevation: Degrees.
        aspect: Width of the picture over its height.
    """
    import numpy as np

    turn, rise = math.radians(azimuth), math.radians(elevation)
    forward = np.array(
        [math.cos(rise) * math.cos(turn), math.cos(rise) * math.sin(turn), math.sin(rise)]
    )
    right = np.array([math.sin(turn), -math.cos(turn), 0.0])
    up = np.cross(right, forward)
    half_high = math.tan(math.radians(FIELD_OF_VIEW) / 2.0) / _MARGIN
    axes = np.array([forward, right, up]).T

    def seen_from(middle: Array) -> tuple[Array, float]:
        """Return how far ahead, right and up the points are, and the distance that sees all."""
        depth, across, high = seen = ((points - middle) @ axes).T
        needed = np.maximum(np.abs(across) / (half_high * aspect), np.abs(high) / half_high) - depth
        return seen, float(needed.max())

    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    # Twice: the middle of what is seen is not that of the box, as near things look larger.
    for _ in range(2):
        (depth, across, high), distance = seen_from(middle)
        away = np.maximum(depth + distance, 1e-9)
        shift = _middle(across / away) * right + _middle(high / away) * up
        middle = middle + shift * distance
    _, distance = seen_from(middle)
    x, y, z = (float(each) for each in middle)
    return Camera((x, y, z), max(distance, 1e-3) * 1.02, azimuth, elevation)


def _middle(numbers: Array) -> float:
    return float(numbers.min() + numbers.max()) / 2.0
