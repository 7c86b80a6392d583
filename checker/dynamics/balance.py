"""What a robot stands on, and how far it is from tipping over."""

from __future__ import annotations

import math
from collections.abc import Iterator

from checker.dynamics.contact import contact_points
from checker.dynamics.polygon import Point, convex_hull, margin
from checker.model.components import Collision, Link
from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.model.transform import Transform, Vector
from checker.record import record

_TOUCHES = 0.01
"""Metres above the lowest point up to which points stand on the ground: wheels sink in, and models
are not drawn more precisely."""
_DOWN: Vector = (0.0, 0.0, -1.0)


@record()
class Stand:
    """What a robot stands on.

    Attributes:
        polygon: Corners (x, y) in the robot's frame, metres, counter-clockwise.
        height: z of the ground in the robot's frame, metres; None if nothing touches it.
        links: Scoped names of what touches it.
        unknown: Why this is not known, as the end of a sentence; empty if it is.
    """

    polygon: tuple[Point, ...] = ()
    height: float | None = None
    links: frozenset[str] = frozenset()
    unknown: str = ""


def stand_of(robot: Robot) -> Stand:
    """Find what a robot stands on: flat ground below its lowest collision shape."""
    lowest: list[tuple[float, Link, Collision, Transform]] = []
    for link, collision in _collisions(robot):
        mesh = robot.mesh_of(collision)
        if isinstance(mesh, MeshFault) and mesh.trouble is not MeshTrouble.MISSING:
            uri = collision.geometry.uri
            return Stand(unknown=f"{uri.value if uri else 'a mesh'} {mesh.reason}")
        pose = robot.pose_of_part(link, collision.pose)
        reach = None if pose is None else robot.support_of(collision.geometry, pose, _DOWN)
        if pose is not None and reach is not None and math.isfinite(reach):
            lowest.append((-reach, link, collision, pose))
    ground = min((each[0] for each in lowest), default=None)
    if ground is None:
        return Stand()
    touching = [each for each in lowest if each[0] <= ground + _TOUCHES]
    points = [
        (x, y)
        for _, _, collision, pose in touching
        for x, y, z in contact_points(collision.geometry, pose, robot.meshes)
        if z <= ground + _TOUCHES
    ]
    names = frozenset(link.scoped_name for _, link, _, _ in touching)
    return Stand(convex_hull(points), ground, names)


def _collisions(robot: Robot) -> Iterator[tuple[Link, Collision]]:
    for link in robot.links:
        for collision in link.collisions:
            yield link, collision


def tip_angle(stand: Stand, centre: Vector | None) -> float | None:
    """Return how far the ground can tilt before the robot tips, radians.

    That is when its centre of mass stands above the nearest edge of what it stands on. Negative
    where it stands outside from the start; None without anything to stand on.
    """
    if centre is None or stand.height is None or not stand.polygon:
        return None
    x, y, z = centre
    return math.atan2(margin(stand.polygon, (x, y)), z - stand.height)
