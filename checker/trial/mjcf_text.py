"""Numbers as MJCF writes them: never one that is not finite, never one that loses digits."""

from __future__ import annotations

import math
from collections.abc import Iterable

from checker.model.transform import Rotation, Transform

FAR = 1e6
"""Metres beyond which a place is taken for a slip: sums of squares must stay exact to 1 mm."""
LARGEST = 1e12
"""Of masses, moments, stiffnesses in SI units; beyond it products in a mass matrix overflow."""

Quaternion = tuple[float, float, float, float]


def usable(value: float, largest: float = LARGEST) -> bool:
    """Return whether a number may stand in a model: finite and not beyond a bound."""
    return abs(value) <= largest


def bounded(value: float, low: float, high: float, default: float) -> float:
    """Return a number within bounds; the default for NaN."""
    return default if math.isnan(value) else min(max(value, low), high)


def numbers(values: Iterable[float]) -> str:
    """Return numbers so that reading them gives the same bits."""
    return " ".join(repr(float(value)) for value in values)


def placed(pose: Transform) -> str:
    """Return the attributes that pose a body or geom."""
    return f'pos="{numbers(pose.translation)}" quat="{numbers(quaternion(pose.rotation))}"'


def well_placed(pose: Transform) -> bool:
    """Return whether a pose is of finite numbers, within `FAR`."""
    turns = [number for row in pose.rotation for number in row]
    return all(usable(each, FAR) for each in pose.translation) and all(map(math.isfinite, turns))


def quaternion(rotation: Rotation) -> Quaternion:
    """Return w, x, y, z of a rotation (Shepperd's method: divides by the largest of the four)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    rows = (
        (1 + xx + yy + zz, zy - yz, xz - zx, yx - xy),
        (zy - yz, 1 + xx - yy - zz, xy + yx, xz + zx),
        (xz - zx, xy + yx, 1 - xx + yy - zz, yz + zy),
        (yx - xy, xz + zx, yz + zy, 1 - xx - yy + zz),
    )
    best = max(range(4), key=lambda i: rows[i][i])
    length = math.hypot(*rows[best])
    w, x, y, z = (each / length for each in rows[best])
    return (w, x, y, z)
