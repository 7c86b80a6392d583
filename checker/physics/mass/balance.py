"""Support of a robot, and the angle at which it tips over."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise, product

from checker.base.record import Record
from checker.model.components import Collision, Link
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.mesh import Mesh, Meshes, MeshFault, mesh_of
from checker.model.robot import Robot

# Convex polygons in the plane: around points, and how far inside a point is.


Point = tuple[float, float]
_NO_DISTANCE = 1e-12
"""Metres below which a distance is what rounding left of none."""


def convex_hull(points: Iterable[Point]) -> tuple[Point, ...]:
    """Return the corners of the convex hull, counter-clockwise (Andrew's monotone chain).

    Of points on one line, the two ends; of one point, itself.
    """
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return tuple(ordered)
    below, above = _chain(ordered), _chain(ordered[::-1])
    return (*below[:-1], *above[:-1])


def _chain(points: Sequence[Point]) -> list[Point]:
    """Return the points at which a walk along one side turns left."""
    chain: list[Point] = []
    for point in points:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def margin(polygon: Sequence[Point], point: Point) -> float:
    """Return the distance of a point from the edges of a polygon; negative when it is outside.

    Args:
        polygon: Corners of a convex polygon, counter-clockwise, at least one.
        point: The point in the units of the corners.
    """
    if len(polygon) == 1:
        return -math.dist(polygon[0], point)
    edges = list(pairwise((*polygon, polygon[0])))
    distance = min(_distance(a, b, point) for a, b in edges)
    inside = len(polygon) > 2 and all(_turn(a, b, point) >= 0.0 for a, b in edges)
    return distance if inside else -distance


def _distance(a: Point, b: Point, point: Point) -> float:
    """Return the distance of a point from a line that ends at a and b."""
    along = (b[0] - a[0], b[1] - a[1])
    square = along[0] ** 2 + along[1] ** 2
    if square == 0.0:
        return math.dist(a, point)
    share = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / square
    share = min(max(share, 0.0), 1.0)
    return math.dist((a[0] + share * along[0], a[1] + share * along[1]), point)


# Where a shape can touch flat ground: its corners, or the lowest points of what is round.


_RIM = 16
"""Points that represent the rim of a disc in a horizontal plane."""
_FLAT = 0.99
"""Cosine of the tilt (8°) up to which a disc counts as lying flat."""


def contact_points(geometry: Geometry, pose: Transform, meshes: Meshes) -> list[Vector]:
    """Return the points of a shape by which it may stand, in the frame of `pose`, metres.

    Among them is its lowest one. Nothing for shapes without end and meshes that are not known; a
    mesh counts by its convex hull.
    """
    numbers = {
        name: tuple(number.value for number in size) for name, size in geometry.sizes.items()
    }
    match geometry.shape:
        case "box":
            points = _corners(numbers["size"])
        case "sphere":
            radius = numbers["radius"][0]
            points = [_lowest_of_ellipsoid((radius, radius, radius), pose)]
        case "ellipsoid":
            points = [_lowest_of_ellipsoid(numbers["radii"], pose)]
        case "cylinder":
            radius, half = numbers["radius"][0], numbers["length"][0] / 2
            points = [*_lowest_of_disc(radius, half, pose), *_lowest_of_disc(radius, -half, pose)]
        case "capsule":
            radius, half = numbers["radius"][0], numbers["length"][0] / 2
            x, y, z = _lowest_of_ellipsoid((radius, radius, radius), pose)
            points = [(x, y, z + half), (x, y, z - half)]
        case "cone":
            radius, half = numbers["radius"][0], numbers["length"][0] / 2
            points = [*_lowest_of_disc(radius, -half, pose), (0.0, 0.0, half)]
        case "mesh":
            points = _hull(geometry, meshes)
        case _:
            points = []
    placed = (pose.apply(point) for point in points)
    return [point for point in placed if all(map(math.isfinite, point))]


def _corners(size: Sequence[float]) -> list[Vector]:
    x, y, z = (length / 2 for length in size)
    return [(a * x, b * y, c * z) for a, b, c in product((-1.0, 1.0), repeat=3)]


def _down(pose: Transform) -> Vector:
    """Return the direction of gravity in the shape's own frame."""
    x, y, z = pose.rotation[2]
    return (-x, -y, -z)


def _lowest_of_ellipsoid(radii: Iterable[float], pose: Transform) -> Vector:
    down = _down(pose)
    scaled = [radius * part for radius, part in zip(radii, down, strict=True)]
    length = math.hypot(*scaled) or 1.0
    x, y, z = (radius * part / length for radius, part in zip(radii, scaled, strict=True))
    return (x, y, z)


def _lowest_of_disc(radius: float, height: float, pose: Transform) -> list[Vector]:
    """Return the lowest point of a disc across z; the whole rim if it is horizontal."""
    x, y, z = _down(pose)
    sideways = math.hypot(x, y)
    points: list[Vector] = []
    if sideways > 0.0:
        points.append((radius * x / sideways, radius * y / sideways, height))
    if abs(z) > _FLAT or not points:
        angles = (2 * math.pi * step / _RIM for step in range(_RIM))
        points += [(radius * math.cos(a), radius * math.sin(a), height) for a in angles]
    return points


def _hull(geometry: Geometry, meshes: Meshes) -> list[Vector]:
    mesh = mesh_of(geometry, meshes)
    if not isinstance(mesh, Mesh):
        return []
    a, b, c = (factor.value for factor in geometry.sizes["scale"])
    return [(a * x, b * y, c * z) for x, y, z in mesh.corners]


TOUCHES = 0.01
"""Metres above the lowest point up to which points stand on the ground: wheels sink in, and models
are not drawn more precisely."""
_DOWN: Vector = (0.0, 0.0, -1.0)


class Stand(Record):
    """Contacts of a robot that stands on the ground.

    Attributes:
        polygon: Corners (x, y) in the robot's frame, metres, counter-clockwise.
        height: z of the ground in the robot's frame, metres; None if nothing touches it.
        links: Scoped names of the links that touch it.
        unknown: The reason why this is not known, as the end of a sentence; empty if it is.
    """

    polygon: tuple[Point, ...] = ()
    height: float | None = None
    links: frozenset[str] = frozenset()
    unknown: str = ""


def stand_of(robot: Robot) -> Stand:
    """Find what a robot stands on: flat ground below its lowest collision shape."""
    lowest: list[tuple[float, Link, Collision, Transform]] = []
    for link, collision in collisions_of(robot):
        mesh = robot.mesh_of(collision)
        if isinstance(mesh, MeshFault):
            uri = collision.geometry.uri
            return Stand(unknown=f"{uri.value if uri else 'a mesh'} {mesh.reason}")
        pose = robot.pose_of_part(link, collision.pose)
        reach = None if pose is None else robot.support_of(collision.geometry, pose, _DOWN)
        if pose is not None and reach is not None and math.isfinite(reach):
            lowest.append((-reach, link, collision, pose))
    ground = min((point[0] for point in lowest), default=None)
    if ground is None:
        return Stand()
    touching = [point for point in lowest if point[0] <= ground + TOUCHES]
    points = [
        (x, y)
        for _, _, collision, pose in touching
        for x, y, z in contact_points(collision.geometry, pose, robot.scaled_meshes)
        if z <= ground + TOUCHES
    ]
    names = frozenset(link.scoped_name for _, link, _, _ in touching)
    return Stand(convex_hull(points), ground, names)


def collisions_of(robot: Robot) -> Iterator[tuple[Link, Collision]]:
    """Yield the collisions of a robot, each with its link."""
    for link in robot.links:
        for collision in link.collisions:
            yield link, collision


def tip_angle(stand: Stand, centre: Vector | None) -> float | None:
    """Return how far the ground can tilt before the robot tips, radians.

    That is when its centre of mass stands above the nearest edge of what it stands on. Negative
    where it is outside from the start; None without anything to stand on.
    """
    if centre is None or stand.height is None or not stand.polygon:
        return None
    x, y, z = centre
    distance = margin(stand.polygon, (x, y))
    return math.atan2(0.0 if abs(distance) < _NO_DISTANCE else distance, z - stand.height)
