"""About and along what a joint lets its child move."""

from __future__ import annotations

import enum
import math

from checker.base.record import Record
from checker.model.components import Joint
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot


class Freedom(enum.StrEnum):
    """What one degree of freedom does."""

    TURN = "turn"
    SLIDE = "slide"
    BALL = "ball"


_FREEDOMS = {
    "revolute": (Freedom.TURN,),
    "continuous": (Freedom.TURN,),
    "hinge": (Freedom.TURN,),
    "prismatic": (Freedom.SLIDE,),
    "universal": (Freedom.TURN, Freedom.TURN),
    "revolute2": (Freedom.TURN, Freedom.TURN),
    "ball": (Freedom.BALL,),
}


AXES = {
    kind: sum(freedom is not Freedom.BALL for freedom in freedoms)
    for kind, freedoms in _FREEDOMS.items()
}
"""How many axes the joints need that move, by their type."""


class Motion(Record):
    """One way in which a joint moves.

    Attributes:
        number: Of the joint's axis, from 0.
        axis: Direction in the robot's frame, of length 1; of a ball, any.
    """

    freedom: Freedom
    number: int
    axis: Vector


def motions_of(robot: Robot, joint: Joint) -> tuple[Motion, ...]:
    """Return how a joint moves, from parent to child; nothing where it is held fixed.

    Types that are not known, axes without direction and limits that leave no range hold it.
    """
    freedoms = _FREEDOMS.get(joint.type.value, ())
    if freedoms == (Freedom.BALL,):
        return (Motion(Freedom.BALL, 0, (0.0, 0.0, 1.0)),)
    motions = []
    for number, (freedom, axis) in enumerate(zip(freedoms, joint.axes, strict=False)):
        direction = robot.axis_in_model(joint, axis)
        endless = joint.type.value == "continuous"
        movable = endless or axis.lower.value != axis.upper.value
        if movable and direction is not None and all(map(math.isfinite, direction)):
            motions.append(Motion(freedom, number, direction))
    return tuple(motions)
