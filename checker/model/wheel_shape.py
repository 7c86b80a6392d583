"""The collision that a wheel rolls on, and whether it stands as the wheel turns."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from checker.model.locomotion import Wheel
from checker.model.placed import Placed, placed

if TYPE_CHECKING:
    from checker.model.robot import Robot

_ROUND = ("cylinder", "capsule", "cone")
"""Shapes that are round about their own z axis and nothing else."""
ASKEW = math.radians(1)
"""From where on a wheel's collision is a shape that stands wrong, and not one of wrong size."""


def wheel_shapes(robot: Robot, wheel: Wheel) -> list[Placed]:
    """Return the collisions of a wheel whose extent is known."""
    return [each for link in wheel.body for each in placed(robot, link, link.collisions)]


def tread(robot: Robot, wheel: Wheel) -> Placed | None:
    """Return the collision that a wheel rolls on: the largest; None when none is known."""
    return max(wheel_shapes(robot, wheel), key=lambda each: each.box.diagonal, default=None)


def askew(robot: Robot, wheel: Wheel) -> float | None:
    """Return the angle between the axis of a wheel's tread and that of its joint, 0…π/2 rad.

    None when one of them has no axis: a sphere or box, a joint whose axis is not known.
    """
    rolls = tread(robot, wheel)
    if rolls is None or wheel.axis is None or rolls.shape.geometry.shape not in _ROUND:
        return None
    along = rolls.pose.rotate((0.0, 0.0, 1.0))
    cosine = abs(sum(a * b for a, b in zip(along, wheel.axis, strict=True)))
    return math.acos(min(cosine, 1.0)) if math.isfinite(cosine) else None


def stands_askew(robot: Robot, wheel: Wheel) -> bool:
    """Say whether a wheel's tread stands across its joint: its reach then says nothing."""
    return (askew(robot, wheel) or 0.0) > ASKEW
