"""Robots that a controller keeps upright: the trial, which runs none, says nothing of their motion.

So does statics: on two wheels of one axle, a robot has no angle at which it tips over.
"""

from __future__ import annotations

import math
import re
from collections.abc import Set
from typing import TYPE_CHECKING

from checker.model.components import Collision, Visual
from checker.model.geometry.transform import Vector, dot
from checker.model.locomotion.locomotion import Wheel

if TYPE_CHECKING:
    from checker.model.robot import Robot

NOT_RUN = "the robot balances with its controller, which the trial does not run"
"""Why the trial does not say how such a robot drives."""

_NAMED = re.compile(r"balanc|segway|pendulum", re.IGNORECASE)
_LEANS = tuple(math.radians(degrees) for degrees in (-15.0, -7.5, 0.0, 7.5, 15.0))
"""Leans at which a robot that balances rests on nothing but its wheels."""
_PARALLEL = 0.99
"""Cosine of the angle between the axles of two wheels; less are not on one line."""
_ON_ONE_LINE = 0.01
"""Metres by which one wheel may be beside the other's axle."""
_LEVEL = 0.1
"""Vertical part of an axle of length 1; more stands on its side."""


def balances(robot: Robot) -> bool:
    """Return whether a controller keeps a robot upright.

    By its name, on two wheels at the ends of legs, or on two wheels of one axle alone.
    """
    free = robot.locomotion.undriven
    parents = (f"{it.joint.scope}{it.joint.parent.value}" for it in free)
    on_legs = len(free) == 2 and robot.tree.base.isdisjoint(parents)
    named = _NAMED.search(robot.name.value) is not None
    driven = robot.locomotion.wheels
    return named or (on_legs and not driven) or _on_one_axle(robot, driven or free)


def _on_one_axle(robot: Robot, wheels: tuple[Wheel, ...]) -> bool:
    """Return whether two wheels alone carry a robot: nothing else reaches the ground.

    Not even after it has leant, and nothing that is only drawn, as a caster without `<collision>`.
    """
    axle = _axle(wheels)
    if axle is None:
        return False
    rolling = {link.scoped_name for wheel in wheels for link in wheel.body}
    return all(_hangs_free(robot, rolling, _down(axle, lean)) for lean in _LEANS)


def _axle(wheels: tuple[Wheel, ...]) -> Vector | None:
    """Return the direction of the level axle that two wheels share; None if they do not."""
    if len(wheels) != 2:
        return None
    one, other = wheels
    if not (one.axis and other.axis and one.centre and other.centre):
        return None
    apart = [b - a for a, b in zip(one.centre, other.centre, strict=True)]
    along = dot(apart, one.axis)
    beside = math.dist(apart, [along * part for part in one.axis])
    is_shared = abs(dot(one.axis, other.axis)) > _PARALLEL and beside < _ON_ONE_LINE
    is_level = abs(one.axis[2]) < _LEVEL
    return one.axis if is_shared and is_level else None


def _down(axle: Vector, lean: float) -> Vector:
    """Return where the ground is, in the frame of a robot that leans about its axle."""
    x, y, _ = axle
    return -y * math.sin(lean), x * math.sin(lean), -math.cos(lean)


def _hangs_free(robot: Robot, rolling: Set[str], down: Vector) -> bool:
    """Return whether all of a robot but its wheels is above the ground, and known to be so."""
    lowest = {True: -math.inf, False: -math.inf}
    for link in robot.links:
        shapes: tuple[Collision | Visual, ...] = (*link.collisions, *link.visuals)
        for shape in shapes:
            pose = robot.pose_of_part(link, shape.pose)
            reach = None if pose is None else robot.support_of(shape.geometry, pose, down)
            if reach is None:
                return False
            is_wheel = link.scoped_name in rolling
            lowest[is_wheel] = max(lowest[is_wheel], reach)
    return -math.inf < lowest[False] < lowest[True]
