"""Collisions and visuals where they are: in the robot's frame, with the box around each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.transform import Transform, Vector

if TYPE_CHECKING:
    from checker.model.robot import Robot


class Placed(Record, eq=False):
    """A shape of a link in the robot's frame.

    Attributes:
        pose: The pose of the shape.
        box: The bounding box of the shape; of a mesh, that of its hull.
    """

    link: Link
    shape: Collision | Visual
    pose: Transform
    box: Box

    def support(self, robot: Robot, direction: Vector) -> float:
        """Return how far it reaches in a direction of length 1, metres."""
        reach = robot.support_of(self.shape.geometry, self.pose, direction)
        # It has a box, so it ends in all directions.
        return reach if reach is not None else 0.0


def place_shapes(
    robot: Robot, link: Link, shapes: Iterable[Collision | Visual]
) -> Iterator[Placed]:
    """Yield the shapes of a link whose extent and place are known.

    Left out: unknown meshes, planes and heightmaps, lengths that are not finite.
    """
    for shape in shapes:
        pose = robot.pose_of_part(link, shape.pose)
        box = robot.box_of_shape(link, shape)
        if pose is not None and box is not None:
            yield Placed(link, shape, pose, box)


def all_shapes(robot: Robot) -> tuple[list[Placed], list[Collision | Visual]]:
    """Return all shapes of a robot, and those whose extent or place is not known."""
    known: list[Placed] = []
    for link in robot.links:
        known += place_shapes(robot, link, (*link.collisions, *link.visuals))
    placed = {piece.shape for piece in known}
    shapes = (shape for shape in robot.shapes() if shape.geometry.shape not in ("", "empty"))
    return known, [shape for shape in shapes if shape not in placed]


def union(boxes: Iterable[Box]) -> Box | None:
    """Return the box around boxes; None without any."""
    known = list(boxes)
    if not known:
        return None
    lows = zip(*(box.low for box in known), strict=True)
    highs = zip(*(box.high for box in known), strict=True)
    (x, y, z), (u, v, w) = map(min, lows), map(max, highs)
    return Box((x, y, z), (u, v, w))
