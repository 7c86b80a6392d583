"""Closed solids out of a few numbers, for the meshes of the samples; lengths in metres."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

Vector = tuple[float, float, float]
Colour = tuple[float, float, float]
"""Red, green and blue, 0…1."""


@dataclass(frozen=True)
class Solid:
    """A closed surface of triangles whose corners run counter-clockwise seen from outside."""

    vertices: tuple[Vector, ...]
    triangles: tuple[tuple[int, int, int], ...]


def extrude(
    profile: Sequence[tuple[float, float]],
    low: float,
    high: float,
    axis: str = "z",
    pieces: Sequence[Sequence[int]] = (),
) -> Solid:
    """Pulls a counter-clockwise outline along an axis.

    Args:
        profile: Corners in the plane of the two other axes, in the cyclic order x, y, z.
        low: Lower end along the axis, in metres.
        high: Upper end along the axis, in metres.
        axis: ``x``, ``y`` or ``z``.
        pieces: Convex parts of a hollow outline, as corner numbers; empty for a convex one.
    """
    count = len(profile)
    turn = {"z": (0, 1, 2), "x": (2, 0, 1), "y": (1, 2, 0)}[axis]

    def place(u: float, v: float, w: float) -> Vector:
        local = (u, v, w)
        return local[turn[0]], local[turn[1]], local[turn[2]]

    vertices = [place(u, v, low) for u, v in profile] + [place(u, v, high) for u, v in profile]
    triangles: list[tuple[int, int, int]] = []
    for i in range(count):
        j = (i + 1) % count
        triangles += [(i, j, count + j), (i, count + j, count + i)]
    for piece in pieces or [range(count)]:
        for b, c in pairwise(piece[1:]):
            triangles += [(piece[0], c, b), (count + piece[0], count + b, count + c)]
    return Solid(tuple(vertices), tuple(triangles))


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Solid:
    """A box between two corners."""
    return extrude([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], z[0], z[1])


def plate(length: float, width: float, height: float, bevel: float) -> Solid:
    """An upright plate with bevelled corners, standing on its origin."""
    a, b = length / 2, width / 2
    c, d = a - bevel, b - bevel
    outline = [(-c, -b), (c, -b), (a, -d), (a, d), (c, b), (-c, b), (-a, d), (-a, -d)]
    return extrude(outline, 0.0, height)


def cylinder(radius: float, length: float, segments: int = 32) -> Solid:
    """A cylinder about the z axis."""
    turns = (2 * math.pi * k / segments for k in range(segments))
    outline = [(radius * math.cos(t), radius * math.sin(t)) for t in turns]
    return extrude(outline, -length / 2, length / 2)


def track(length: float, radius: float, width: float, segments: int = 16) -> Solid:
    """A track along the x axis: a belt around two wheels.

    Args:
        length: Between the middles of the wheels, in metres.
        radius: Of a wheel with its belt, in metres.
        width: Along the y axis, in metres.
        segments: Of each half circle.
    """
    turns = [math.pi * k / segments for k in range(segments + 1)]
    front = [(radius * math.cos(t), length / 2 + radius * math.sin(t)) for t in turns]
    rear = [(-z, -x) for z, x in front]
    return extrude([*front, *rear], -width / 2, width / 2, "y")


def wheel(radius: float, width: float, segments: int = 32) -> Solid:
    """A wheel about the y axis with rounded shoulders; ``segments`` is a multiple of four."""
    half = width / 2
    rings = [
        (0.9 * radius, -half),
        (radius, -0.7 * half),
        (radius, 0.7 * half),
        (0.9 * radius, half),
    ]
    vertices: list[Vector] = [(0.0, -half, 0.0), (0.0, half, 0.0)]
    for r, y in rings:
        turns = (2 * math.pi * k / segments for k in range(segments))
        vertices += [(r * math.cos(t), y, r * math.sin(t)) for t in turns]
    triangles: list[tuple[int, int, int]] = []
    last = 2 + (len(rings) - 1) * segments
    for k in range(segments):
        n = (k + 1) % segments
        triangles += [(0, 2 + k, 2 + n), (1, last + n, last + k)]
        for ring in range(len(rings) - 1):
            a, b = 2 + ring * segments, 2 + (ring + 1) * segments
            triangles += [(a + k, b + k, b + n), (a + k, b + n, a + n)]
    return Solid(tuple(vertices), tuple(triangles))


def minus(a: Vector, b: Vector) -> Vector:
    """The vector from ``b`` to ``a``."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The cross product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a: Vector) -> Vector:
    """The same direction with length one."""
    length = math.sqrt(dot(a, a))
    return a[0] / length, a[1] / length, a[2] / length


def normal(solid: Solid, triangle: tuple[int, int, int]) -> Vector:
    """The outward unit normal of a triangle."""
    a, b, c = (solid.vertices[i] for i in triangle)
    return unit(cross(minus(b, a), minus(c, a)))


Meshes = dict[str, tuple[Solid, Colour]]
"""The meshes of a robot, by file name without ``.dae``."""
