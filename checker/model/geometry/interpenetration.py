"""Parts of a robot that may move relative to each other and overlap at the start."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import combinations
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.geometry.boxes import close_pairs
from checker.model.geometry.convex import face_directions, overlap_depth
from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.mesh import Mesh
from checker.model.tree import RigidBodies

if TYPE_CHECKING:
    from checker.model.robot import Robot

_FILLS = 0.9
"""Share of its hull that a mesh must fill to count as convex."""
DEEP_PAIRS = 60
"""Greatest number of findings: each takes some ms."""


class Inside(Record, eq=False):
    """Two collisions of different parts.

    Attributes:
        one: The larger.
        other: The smaller.
        depth: The shortest way that parts them, metres.
    """

    one: Placed
    other: Placed
    depth: float


def interpenetrations(robot: Robot, depth: float) -> Iterator[Inside]:
    """Yield pairs of links that start more than `depth` metres inside each other, once each.

    Only parts that no joint ties: neither directly nor over parts without collision, such as the
    knuckle of a steered wheel. Two wheels may overlap: rows of them represent a track. Meshes
    count where they are nearly convex.

    Raises:
        TooManyPairs: More collisions lie side by side than are compared.
    """
    shapes = [
        piece
        for link in robot.tree.links.values()
        for piece in place_shapes(robot, link, link.collisions)
        if is_convex(robot, piece)
    ]
    bodies = robot.tree.rigid_bodies
    tied = _tied(robot, bodies)
    wheels = {link.scoped_name for link in robot.wheels}
    pairs: set[tuple[str, str]] = set()
    for first, second in close_pairs([shape.box for shape in shapes], -depth):
        one, other = shapes[first], shapes[second]
        a, b = one.link.scoped_name, other.link.scoped_name
        pair = (min(a, b), max(a, b))
        body, beside = bodies.of_link[a], bodies.of_link[b]
        if pair in pairs or body == beside or beside in tied.get(body, ()):
            continue
        if a in wheels and b in wheels:
            continue
        deep = _depth(robot, one, other, depth)
        if deep > depth:
            pairs.add(pair)
            larger, smaller = sorted((one, other), key=_bulk, reverse=True)
            yield Inside(larger, smaller, deep)
            if len(pairs) >= DEEP_PAIRS:
                return


def _bulk(shape: Placed) -> float:
    return shape.box.diagonal


def _depth(robot: Robot, one: Placed, other: Placed, enough: float) -> float:
    start = list(face_directions(one.pose.rotation, other.pose.rotation))
    between = [b - a for a, b in zip(one.box.centre, other.box.centre, strict=True)]
    length = math.hypot(*between)
    if 0.0 < length < math.inf:
        start.append((between[0] / length, between[1] / length, between[2] / length))
    return overlap_depth(partial(one.support, robot), partial(other.support, robot), start, enough)


def is_convex(robot: Robot, shape: Placed) -> bool:
    """Return whether a shape is convex, a mesh nearly so."""
    mesh = robot.mesh_of(shape.shape)
    if mesh is None:
        return True
    return isinstance(mesh, Mesh) and (mesh.volume or 0.0) >= _FILLS * mesh.hull_volume > 0.0


def _tied(robot: Robot, bodies: RigidBodies) -> dict[str, set[str]]:
    """Return the bodies next to each body; those next to one without collision count as tied."""
    tied = {body: set(others) for body, others in bodies.neighbours.items()}
    for body, others in bodies.neighbours.items():
        names = bodies.links[body]
        if len(others) <= _FEW and not any(robot.tree.links[name].collisions for name in names):
            for one, other in combinations(others, 2):
                tied[one].add(other)
                tied[other].add(one)
    return tied


_FEW = 8
"""Neighbours of a part without collision up to which they count as tied to each other."""
