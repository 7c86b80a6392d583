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


def undriven_wheels(robot: Robot) -> Iterator[Wheel]:
    """Yield links that are called wheels and turn freely about an axis that lies.

    Wheels of casters and of swerve drives are left out: they turn freely about an upright axis
    too, and which way their own axes point says nothing.
    """
    reader = WheelReader(robot)
    called = {link.scoped_name for link in robot.wheels}
    for tie in robot.tree.ties:
        if tie.child not in called or not _turns_freely(tie.joint):
            continue
        if _hangs_on_one_that_turns(robot, tie.parent):
            continue
        wheel = reader.below(tie.joint, Side.LEFT, {})
        if wheel is None or wheel.axis is None or wheel.centre is None:
            continue
        if abs(wheel.axis[2]) <= _LIES:
            left = wheel.centre[1] > 0.0
            yield wheel if left else replace(wheel, side=Side.RIGHT)


def _hangs_on_one_that_turns(robot: Robot, link: str) -> bool:
    """Say whether the first joint above a link that moves turns without end."""
    seen: set[str] = set()
    while link not in seen and (above := robot.tree.above.get(link)):
        seen.add(link)
        if above[0].joint.type.value != "fixed":
            return _turns_freely(above[0].joint)
        link = above[0].parent
    return False


def _turns_freely(joint: Joint) -> bool:
    """Say whether a joint turns without end."""
    if joint.type.value not in ("continuous", "revolute") or len(joint.axes) != 1:
        return False
    lower, upper = joint.axes[0].lower.value, joint.axes[0].upper.value
    return joint.type.value == "continuous" or upper - lower >= 2 * math.pi
