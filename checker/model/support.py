"""How far a shape reaches in a direction: its support function, and the same both ways."""

from __future__ import annotations

import math

from checker.model.mesh import Mesh, Meshes, NoMeshes, mesh_of
from checker.model.shapes import Geometry
from checker.model.transform import Transform, Vector

_NO_MESHES = NoMeshes()

Extent = tuple[float, float]
"""The least and the greatest `direction · p` of all points p of a shape, metres."""


def support(
    geometry: Geometry, pose: Transform, direction: Vector, meshes: Meshes = _NO_MESHES
) -> float | None:
    """Return the largest `direction · p` of all points p of a shape, in metres.

    None for meshes that are not known and for shapes without end.

    Args:
        geometry: The shape.
        pose: Of the shape, in the frame of `direction`.
        direction: Of length 1.
        meshes: Of the robot; a mesh reaches as far as its convex hull.
    """
    reach = extent(geometry, pose, direction, meshes)
    return None if reach is None else reach[1]


def extent(
    geometry: Geometry, pose: Transform, direction: Vector, meshes: Meshes = _NO_MESHES
) -> Extent | None:
    """Return how far a shape reaches against a direction and along it; as for `support`."""
    own = own_extent(geometry, pose.inverse.rotate(direction), meshes)
    if own is None:
        return None
    middle = sum(a * b for a, b in zip(direction, pose.translation, strict=True))
    return middle + own[0], middle + own[1]


def own_extent(geometry: Geometry, local: Vector, meshes: Meshes) -> Extent | None:
    """Return the extent of a shape about its own centre, along a direction of its own frame."""
    x, y, z = local
    sideways = math.hypot(x, y)
    reach: float | None = None
    match geometry.shape:
        case "box":
            halves = (size / 2 for size in _lengths(geometry, "size"))
            reach = sum(abs(part) * half for part, half in zip(local, halves, strict=True))
        case "sphere":
            reach = _length(geometry, "radius")
        case "cylinder":
            height = _length(geometry, "length") / 2
            reach = abs(z) * height + sideways * _length(geometry, "radius")
        case "capsule":
            reach = abs(z) * _length(geometry, "length") / 2 + _length(geometry, "radius")
        case "cone":
            height = _length(geometry, "length") / 2
            rim = sideways * _length(geometry, "radius")
            return min(z * height, -z * height - rim), max(z * height, -z * height + rim)
        case "ellipsoid":
            radii = _lengths(geometry, "radii")
            reach = math.hypot(*(part * radius for part, radius in zip(local, radii, strict=True)))
        case "mesh":
            mesh = mesh_of(geometry, meshes)
            return _extent_of(mesh, geometry, local) if isinstance(mesh, Mesh) else None
    return None if reach is None else (-reach, reach)


def _extent_of(mesh: Mesh, geometry: Geometry, local: Vector) -> Extent:
    """Return the extent of a mesh with its `<scale>`, which mirrors where it is negative."""
    # d · (s p) = (s d) · p: one vector is scaled instead of all corners.
    x, y, z = (a * b for a, b in zip(local, _lengths(geometry, "scale"), strict=True))
    # A list: a generator takes half as long again, and hulls have hundreds of corners.
    reaches = [x * a + y * b + z * c for a, b, c in mesh.corners]
    return min(reaches), max(reaches)


def _lengths(geometry: Geometry, name: str) -> tuple[float, ...]:
    return tuple(length.value for length in geometry.sizes[name])


def _length(geometry: Geometry, name: str) -> float:
    return geometry.sizes[name][0].value
