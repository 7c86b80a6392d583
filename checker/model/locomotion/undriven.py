"""Wheels by their names, of a robot that no plugin drives."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.model.components import Joint
from checker.model.locomotion.locomotion import Side, Wheel
from checker.model.locomotion.wheels import WheelReader

if TYPE_CHECKING:
    from checker.model.robot import Robot

_LIES = 0.5
"""Cosine of the angle between an axis and the vertical, above which it is none to roll about."""

_PARTS = 8
"""Links fixed to each other between a wheel and what it swivels with; a caster's fork is one."""


def undriven_wheels(robot: Robot) -> Iterator[Wheel]:
    """Yield links that are called wheels and turn freely about an axis that lies.

    Casters and swerve drives turn freely about an upright axis too: that joint steers them.
    """
    reader = WheelReader(robot)
    called = {link.scoped_name for link in robot.wheels}
    for tie in robot.tree.ties:
        if tie.child not in called or not _turns_freely(tie.joint):
            continue
        pivot = _pivot(robot, tie.parent)
        wheel = reader.wheel_below(tie.joint, Side.LEFT, {tie.parent: pivot} if pivot else {})
        if wheel is None or wheel.axis is None or wheel.centre is None:
            continue
        if abs(wheel.axis[2]) <= _LIES:
            left = wheel.centre[1] > 0.0
            yield wheel if left else replace(wheel, side=Side.RIGHT)


def _pivot(robot: Robot, link: str) -> Joint | None:
    """Return the first joint above a link that moves, if it turns without end."""
    for _ in range(_PARTS):
        above = robot.tree.ties_above.get(link)
        if not above:
            return None
        if above[0].joint.type.value != "fixed":
            return above[0].joint if _turns_freely(above[0].joint) else None
        link = above[0].parent
    return None


def _turns_freely(joint: Joint) -> bool:
    """Return whether a joint turns without end."""
    if joint.type.value not in ("continuous", "revolute") or len(joint.axes) != 1:
        return False
    lower, upper = joint.axes[0].lower.value, joint.axes[0].upper.value
    return joint.type.value == "continuous" or upper - lower >= 2 * math.pi
