"""Alignment of the wheels of one side with those of the other side."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.geometry.transform import Vector
from checker.model.locomotion.locomotion import Side, Wheel, WheelDrive
from checker.model.locomotion.wheel_positions import FARTHEST, middle_of

if TYPE_CHECKING:
    from checker.model.robot import Robot


class OutOfLine(Record, eq=False):
    """A wheel that stands farther out than the next wheel, where the other side has no such step.

    Attributes:
        wheel: The one farther out.
        neighbour: The wheel in front of it or behind it, on the same side.
        step: Metres by which it stands farther out.
        other_step: Metres by which the wheel across it stands farther out than its own adjacent
            wheel.
    """

    wheel: Wheel
    neighbour: Wheel
    step: float
    other_step: float


class _Placed(Record, eq=False):
    wheel: Wheel
    along: float
    out: float


def wheels_out_of_line(robot: Robot, tolerance: float) -> Iterator[OutOfLine]:
    """Yield wheels of which a robot is not symmetric, by more than `tolerance` metres.

    Only drives with as many wheels on the left as on the right are compared, each wheel with the
    next one of its side; a step that both sides have is meant so.
    """
    for drive in robot.locomotion.wheel_drives:
        left, right = (_in_order(robot, drive, side) for side in Side)
        if len(left) != len(right) or len(left) != len(drive.wheels_on(Side.LEFT)):
            continue
        for pair in zip(pairwise(left), pairwise(right), strict=True):
            steps = [behind.out - front.out for front, behind in pair]
            if abs(steps[0] - steps[1]) > tolerance:
                worse = 0 if abs(steps[0]) > abs(steps[1]) else 1
                near, far = sorted(pair[worse], key=lambda placed: placed.out)
                sign = 1 if steps[worse] > 0 else -1
                step, other = abs(steps[worse]), sign * steps[1 - worse]
                yield OutOfLine(far.wheel, near.wheel, step, other)


_TILTED = 0.1
"""Radians by which an axle is turned about the vertical on purpose, or by mistake."""


def _across(drive: WheelDrive) -> Vector | None:
    """Return the direction across the robot: along an axle it is wrong by the axle's own tilt."""
    axis = drive.axis
    if axis is None:
        return None
    x, y, _ = axis
    if abs(x) <= _TILTED * abs(y):
        return (0.0, math.copysign(1.0, y), 0.0)
    if abs(y) <= _TILTED * abs(x):
        return (math.copysign(1.0, x), 0.0, 0.0)
    return axis


def _in_order(robot: Robot, drive: WheelDrive, side: Side) -> list[_Placed]:
    """Return the wheels of a side whose place is known, along the robot."""
    if (axis := _across(drive)) is None:
        return []
    placed = []
    for wheel in drive.wheels_on(side):
        if (middle := middle_of(robot, wheel)) is not None:
            across = middle[0] * axis[0] + middle[1] * axis[1]
            along = middle[0] * axis[1] - middle[1] * axis[0]
            if max(abs(across), abs(along)) < FARTHEST:
                placed.append(_Placed(wheel, along, across if side is Side.LEFT else -across))
    return sorted(placed, key=lambda each: each.along)
