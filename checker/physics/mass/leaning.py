"""What carries a robot that first leans a little, as on wheels of two sizes or high casters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from checker.base.record import Record
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.physics.mass.balance import (
    TOUCHES,
    Point,
    collisions_of,
    contact_points,
    convex_hull,
    margin,
)

_LEANS = math.radians(5.0)
"""The greatest lean of a robot that still stands, as on wheels of two sizes."""
_LEANS_FAR = math.radians(15.0)
"""The greatest lean of a robot on casters that are too high; farther, it lies on them."""


def collision_points(robot: Robot) -> list[Vector]:
    """Return the points of all collisions that may touch the ground, in metres."""
    return _all_points(_points_of_links(robot))


def _all_points(of_links: Mapping[str, Sequence[Vector]]) -> list[Vector]:
    return [point for points in of_links.values() for point in points]


def _points_of_links(robot: Robot) -> dict[str, list[Vector]]:
    points: dict[str, list[Vector]] = {}
    for link, collision in collisions_of(robot):
        pose = robot.pose_of_part(link, collision.pose)
        if pose is not None:
            found = contact_points(collision.geometry, pose, robot.scaled_meshes)
            points.setdefault(link.scoped_name, []).extend(found)
    return points


def leaning_polygon(points: Sequence[Vector], centre: Vector) -> tuple[Point, ...]:
    """Return what carries a robot that may lean a little until other parts carry it, too.

    It rests on the sides of the hull around its collisions that are nearly level and face down.

    Args:
        points: The points of its collisions, in metres.
        centre: The centre of mass, in metres.
    """
    return _outline(_lower_sides(points, centre, _LEANS))


class _Side(Record):
    """A side of the hull that faces down: how far it leans, and the points near it."""

    lean: float
    points: tuple[Vector, ...]


def _lower_sides(points: Sequence[Vector], centre: Vector, most: float) -> Iterator[_Side]:
    # Few robots need it, and it takes long to load.
    from scipy.spatial import ConvexHull, QhullError

    try:
        # What only wheels carry touches in one plane: with the centre of mass above, it has a hull.
        hull = ConvexHull([*points, centre])
    except (QhullError, ValueError):
        return
    for x, y, z, offset in hull.equations.tolist():
        if -z >= math.cos(most):
            near = (it for it in points if _depth(it, (x, y, z)) - offset <= TOUCHES)
            yield _Side(math.acos(min(-z, 1.0)), tuple(near))


def _depth(point: Vector, direction: Vector) -> float:
    return -sum(a * b for a, b in zip(point, direction, strict=True))


class HighParts(Record):
    """Parts that carry a robot only after it leans, as they do not reach the ground.

    Attributes:
        lean: How far it leans, radians.
        tip_angle: How far the ground can tilt until it tips over them, radians.
        gaps: Scoped names of their links, each with its height above the ground, metres.
    """

    lean: float
    tip_angle: float
    gaps: Mapping[str, float]


def high_parts(robot: Robot, centre: Vector, ground: float) -> HighParts | None:
    """Return the parts on which a robot rests when it leans; None if it does not come to rest.

    Args:
        robot: The robot.
        centre: Its centre of mass, metres.
        ground: z of the ground below its lowest part, metres.
    """
    of_links, below = _points_of_links(robot), (centre[0], centre[1])
    sides = [*_lower_sides(_all_points(of_links), centre, _LEANS_FAR)]
    under = [it for it in sides if margin(_outline([it]), below) >= -TOUCHES]
    touching = {point for side in under for point in side.points}
    gaps = {
        name: min(z for _, _, z in points) - ground
        for name, points in of_links.items()
        if not touching.isdisjoint(points)
    }
    high = {name: gap for name, gap in gaps.items() if gap > TOUCHES}
    if not high:
        return None
    tip_angle = math.atan2(margin(_outline(sides), below), centre[2] - ground)
    return HighParts(max(side.lean for side in under), tip_angle, high)


def _outline(sides: Iterable[_Side]) -> tuple[Point, ...]:
    return convex_hull((x, y) for side in sides for x, y, _ in side.points)
