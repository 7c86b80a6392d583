"""The robots of a package in the gravity of the worlds in which they start."""

from __future__ import annotations

from collections.abc import Iterable

from msgspec.structs import replace

from checker.base.record import Record
from checker.model.robot import EARTH_GRAVITY, Robot
from checker.model.world import World


class PlacedRobots(Record):
    """The robots of a package, each with the gravity of its world."""

    robots: tuple[Robot, ...]


def placed(robot: Robot, worlds: Iterable[World | None]) -> Robot:
    """Return a robot in the greatest downward gravity of the worlds in which it starts.

    Args:
        robot: The robot.
        worlds: The worlds, None for one that is not known. Such a world has the gravity of the
            Earth, and so has one that states none.
    """
    return replace(robot, gravity=max(map(_downwards, worlds), default=EARTH_GRAVITY))


def _downwards(world: World | None) -> float:
    if world is None or world.element.child("gravity") is None:
        return EARTH_GRAVITY
    return max(0.0, -world.gravity[2])
