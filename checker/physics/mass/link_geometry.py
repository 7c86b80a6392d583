"""The shapes of a link as a whole, for comparing its inertia with them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import union
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.solids import solid_of
from checker.model.geometry.transform import Transform, Vector
from checker.model.mesh import Mesh, Meshes, MeshFault, MeshTrouble, mesh_of
from checker.model.robot import Robot

# How far a shape reaches from a point: closed formulas.


def farthest(geometry: Geometry, pose: Transform, point: Vector, meshes: Meshes) -> float | None:
    """Return the distance of a point from the farthest point of a shape, metres.

    None as for `solid_of`.

    Args:
        geometry: The shape.
        pose: The pose of the shape, in the frame of `point`.
        point: The point to measure from.
        meshes: The meshes of the robot.
    """
    size = {name: tuple(number.value for number in sizes) for name, sizes in geometry.sizes.items()}
    x, y, z = pose.inverse.apply(point)
    beside = math.hypot(x, y)
    reach: float | None = None
    match geometry.shape:
        case "box":
            a, b, c = size["size"]
            reach = math.hypot(abs(x) + a / 2, abs(y) + b / 2, abs(z) + c / 2)
        case "sphere":
            reach = math.hypot(x, y, z) + size["radius"][0]
        case "cylinder":
            radius, half = size["radius"][0], size["length"][0] / 2
            reach = math.hypot(beside + radius, abs(z) + half)
        case "capsule":
            radius, half = size["radius"][0], size["length"][0] / 2
            reach = math.hypot(beside, abs(z) + half) + radius
        case "cone":
            radius, half = size["radius"][0], size["length"][0] / 2
            reach = max(math.hypot(beside, z - half), math.hypot(beside + radius, z + half))
        case "ellipsoid":
            # No closed formula; the box around it reaches a little farther.
            a, b, c = size["radii"]
            reach = math.hypot(abs(x) + a, abs(y) + b, abs(z) + c)
        case "mesh":
            mesh = mesh_of(geometry, meshes)
            if isinstance(mesh, Mesh):
                a, b, c = size["scale"]
                corners = ((a * u, b * v, c * w) for u, v, w in mesh.corners)
                reach = max(math.dist((x, y, z), corner) for corner in corners)
    return reach if reach is None or math.isfinite(reach) else None


_Shape = Collision | Visual
_PLAIN = ("box", "sphere", "cylinder", "capsule")
_NOTHING = ("", "empty")
_PLACEHOLDER = 0.002
"""Metres: boxes, balls and cylinders of up to this size are written where a shape is required."""


def solid(shapes: Iterable[_Shape]) -> list[_Shape]:
    """Return the shapes that take room."""
    return [shape for shape in shapes if shape.geometry.shape not in _NOTHING]


def _is_placeholder(shape: _Shape) -> bool:
    geometry = shape.geometry
    sizes = [number.value for values in geometry.sizes.values() for number in values]
    return geometry.shape in _PLAIN and 0.0 < max(sizes, default=0.0) <= _PLACEHOLDER


def unknown_mesh(robot: Robot, link: Link) -> str:
    """Return why a mesh of a link is not known, as the end of a sentence; empty if all are."""
    return next((reason for reason, _ in _unknown_meshes(robot, link)), "")


def not_looked_at(robot: Robot, link: Link) -> str:
    """Return the same, but nothing for files that other rules report: missing or broken ones."""
    reasons = _unknown_meshes(robot, link)
    return next((why for why, trouble in reasons if trouble is MeshTrouble.NOT_LOOKED_AT), "")


def _unknown_meshes(robot: Robot, link: Link) -> Iterator[tuple[str, MeshTrouble]]:
    for shape in solid((*link.collisions, *link.visuals)):
        mesh = robot.mesh_of(shape)
        if isinstance(mesh, MeshFault):
            uri = shape.geometry.uri
            yield f"{uri.value if uri else 'a mesh'} {mesh.reason}", mesh.trouble


def _placed(robot: Robot, link: Link) -> Iterator[tuple[_Shape, Transform]]:
    """Yield the shapes of a link that are known, with their poses in the robot's frame."""
    for shape in solid((*link.collisions, *link.visuals)):
        pose = robot.pose_of_part(link, shape.pose)
        if pose is not None and not isinstance(robot.mesh_of(shape), MeshFault):
            yield shape, pose


def displacement(robot: Robot, link: Link, centre: Vector) -> float:
    """Return how far a centre of mass is outside the box around a link's shapes.

    As a multiple of the box's diagonal; 0 if the box is not known.
    """
    box = known_box(robot, link)
    return box.gap(Box(centre, centre)) / box.diagonal if box and box.diagonal else 0.0


def known_box(robot: Robot, link: Link) -> Box | None:
    """Return the box around the shapes of a link that are known, in the robot's frame.

    Placeholders do not count.
    """
    placed = (shape for shape, _ in _placed(robot, link) if not _is_placeholder(shape))
    boxes = [robot.box_of_shape(link, shape) for shape in placed]
    known = [box for box in boxes if box is not None]
    return union(known) if len(known) == len(boxes) else None


def known_reach(robot: Robot, link: Link, point: Vector) -> float | None:
    """Return the distance of a point from the farthest point of a link's known shapes, metres.

    None without such shapes, and where one has no end.

    Args:
        robot: The robot of the link.
        link: Its collisions and visuals count.
        point: The point in the robot's frame, metres.
    """
    reaches = []
    for shape, pose in _placed(robot, link):
        reach = farthest(shape.geometry, pose, point, robot.scaled_meshes)
        if reach is None:
            return None
        reaches.append(reach)
    return max(reaches, default=None)


def volume_bounds(robot: Robot, shapes: Iterable[_Shape]) -> tuple[float, float] | None:
    """Return the least and the greatest volume that shapes fill together, m³.

    They may be in one another: the largest alone, and all side by side. None without shapes other
    than placeholders, and where one is not known.
    """
    counted = (shape for shape in solid(shapes) if not _is_placeholder(shape))
    solids = [solid_of(shape.geometry, robot.scaled_meshes) for shape in counted]
    known = [each.amount for each in solids if each is not None]
    if not known or len(known) < len(solids):
        return None
    total = math.fsum(known) if max(known) < 1e300 else math.inf
    return max(known), total
