"""The shapes of a link as a whole, for comparing its inertia with them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from checker.dynamics.shape_size import farthest, volume_of
from checker.model.boxes import Box
from checker.model.components import Collision, Link, Visual
from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.placed import union
from checker.model.robot import Robot
from checker.model.transform import Transform, Vector

_Shape = Collision | Visual
_NOTHING = ("", "empty")


def solid(shapes: Iterable[_Shape]) -> list[_Shape]:
    """Return the shapes that take room."""
    return [shape for shape in shapes if shape.geometry.shape not in _NOTHING]


def not_looked_at(robot: Robot, link: Link) -> str:
    """Return why a mesh of a link is not known, as the end of a sentence.

    Empty when all are, and for files that are missing or broken: other rules say so.
    """
    for shape in solid((*link.collisions, *link.visuals)):
        mesh = robot.mesh_of(shape)
        if isinstance(mesh, MeshFault) and mesh.trouble is MeshTrouble.NOT_LOOKED_AT:
            uri = shape.geometry.uri
            return f"the mesh {uri.value if uri else ''} {mesh.reason}"
    return ""


def _placed(robot: Robot, link: Link) -> Iterator[tuple[_Shape, Transform]]:
    """Yield the shapes of a link that are known, with their poses in the robot's frame."""
    for shape in solid((*link.collisions, *link.visuals)):
        pose = robot.pose_of_part(link, shape.pose)
        if pose is not None and not isinstance(robot.mesh_of(shape), MeshFault):
            yield shape, pose


def known_box(robot: Robot, link: Link) -> Box | None:
    """Return the box around the shapes of a link that are known, in the robot's frame."""
    boxes = [robot.box_of_shape(link, shape) for shape, _ in _placed(robot, link)]
    known = [box for box in boxes if box is not None]
    return union(known) if len(known) == len(boxes) else None


def known_reach(robot: Robot, link: Link, point: Vector) -> float | None:
    """Return the distance of a point from the farthest point of a link's known shapes, metres.

    None without such shapes, and where one has no end.

    Args:
        robot: Whose link it is.
        link: Its collisions and visuals count.
        point: In the robot's frame, metres.
    """
    reaches = []
    for shape, pose in _placed(robot, link):
        reach = farthest(shape.geometry, pose, point, robot.meshes)
        if reach is None:
            return None
        reaches.append(reach)
    return max(reaches, default=None)


def volume_bounds(robot: Robot, shapes: Iterable[_Shape]) -> tuple[float, float] | None:
    """Return the least and the greatest volume that shapes fill together, m³.

    They may lie in one another: the largest alone, and all side by side. None without shapes, and
    where one is not known.
    """
    volumes = [volume_of(shape.geometry, robot.meshes) for shape in solid(shapes)]
    known = [volume for volume in volumes if volume is not None]
    if not known or len(known) < len(volumes):
        return None
    total = math.fsum(known) if max(known) < 1e300 else math.inf
    return max(known), total
