"""Where a shape can touch flat ground: its corners, or the lowest points of what is round."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import product

from checker.model.mesh import Mesh, Meshes, mesh_of
from checker.model.shapes import Geometry
from checker.model.transform import Transform, Vector

_RIM = 16
"""Points that stand for the rim of a disc that lies flat."""
_FLAT = 0.99
"""Cosine of the tilt (8°) up to which a disc counts as lying flat."""


def contact_points(geometry: Geometry, pose: Transform, meshes: Meshes) -> list[Vector]:
    """Return the points of a shape by which it may stand, in the frame of `pose`, metres.

    Among them is its lowest one. Nothing for shapes without end and meshes that are not known; a
    mesh counts by its convex hull.
    """
    numbers = {name: tuple(each.value for each in size) for name, size in geometry.sizes.items()}
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
    """Return the lowest point of a disc across z; the whole rim where it lies flat."""
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
