"""Depth of the overlap of two convex shapes.

The depth is the shortest shift that separates them: the least overlap over all directions, where
the overlap along d is h_A(d) + h_B(−d) and h is the support function. Any direction gives an upper
bound, so one direction is enough to show that shapes are apart, or nearly so. The other result
takes a search over the sphere, from the directions in which polyhedra separate.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress

from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Rotation, Transform, Vector
from checker.model.mesh import Mesh, Meshes, NoMeshes, mesh_of

# How far a shape reaches in a direction: its support function, and the same both ways.


_NO_MESHES = NoMeshes()

Extent = tuple[float, float]
"""The least and the greatest `direction · p` of all points p of a shape, metres."""


def support(
    geometry: Geometry, pose: Transform, direction: Vector, meshes: Meshes = _NO_MESHES
) -> float | None:
    """Return the largest `direction · p` of all points p of a shape, in metres.

    None for meshes that are not known and for shapes without end or size.

    Args:
        geometry: The shape.
        pose: The pose of the shape, in the frame of `direction`.
        direction: The direction, of length 1.
        meshes: The meshes of the robot; a mesh reaches as far as its convex hull.
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
    """Return the extent of a shape about its own centre, along a direction in its own frame."""
    if not geometry.has_size:
        return None
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
    # To load numpy takes longer than to go through the corners of a whole robot a few times.
    if len(mesh.hull) > _MANY and "numpy" in sys.modules:
        a, b, c = mesh.columns
        along = x * a + y * b + z * c
        return float(along.min()), float(along.max())
    # A list: a generator takes half as long again.
    reaches = [x * a + y * b + z * c for a, b, c in mesh.corners]
    return min(reaches), max(reaches)


_MANY = 200
"""Corners from which on numpy is the faster."""


def _lengths(geometry: Geometry, name: str) -> tuple[float, ...]:
    return tuple(length.value for length in geometry.sizes[name])


def _length(geometry: Geometry, name: str) -> float:
    return geometry.sizes[name][0].value


Support = Callable[[Vector], float]
"""Function from a direction of length 1 to the extent of a shape in it, metres."""

_AROUND = 96
"""Directions all around that the search starts with: adjacent ones are 20° apart."""
_BEST = 6
"""Number of the first directions that are followed downhill."""
_FIRST_STEP = 0.2
_LAST_STEP = 1e-4
"""Radians; the overlap is then exact to a share of 1e-4 of the shapes' size, at worst."""


def overlap_depth(
    one: Support, other: Support, start: Sequence[Vector], enough: float = 0.0
) -> float:
    """Return how deep two shapes are inside each other, metres; negative where they are apart.

    Where a direction is found in which they overlap by no more than `enough`, that overlap is
    returned: the depth is no larger.

    Args:
        one: Support of a shape.
        other: Support of the other, in the same frame.
        start: Likely directions, of length 1: normals of faces, from centre to centre.
        enough: The depth that matters, metres.
    """

    def along(d: Vector) -> float:
        return one(d) + other((-d[0], -d[1], -d[2]))

    tried: list[tuple[float, Vector]] = []
    for direction in _both_ways(start):
        tried.append((along(direction), direction))
        if tried[-1][0] <= enough:
            return tried[-1][0]
    # Hundreds of support points follow: those of meshes are faster with it.
    with suppress(ImportError):
        pass
    for direction in _SPHERE:
        tried.append((along(direction), direction))
        if tried[-1][0] <= enough:
            return tried[-1][0]
    tried.sort(key=lambda direction: direction[0])
    least = math.inf
    for overlap, direction in tried[:_BEST]:
        least = min(least, _downhill(along, direction, overlap, enough))
        if least <= enough:
            break
    return least


def face_directions(one: Rotation, other: Rotation) -> Iterator[Vector]:
    """Yield the axes of two frames and their cross products: where two boxes can part."""
    columns = [_columns(one), _columns(other)]
    yield from columns[0]
    yield from columns[1]
    for a in columns[0]:
        for b in columns[1]:
            cross = _cross(a, b)
            length = math.hypot(*cross)
            if length > 1e-6:
                yield (cross[0] / length, cross[1] / length, cross[2] / length)


def _downhill(along: Support, direction: Vector, overlap: float, enough: float) -> float:
    """Return the least overlap near a direction: step to the best of eight, else step shorter."""
    step = _FIRST_STEP
    while step > _LAST_STEP and overlap > enough:
        near = [(along(other), other) for other in _ring(direction, step)]
        best, towards = min(near, key=lambda pair: pair[0])
        if best < overlap:
            overlap, direction = best, towards
        else:
            step /= 2
    return overlap


def _ring(direction: Vector, step: float) -> Iterator[Vector]:
    u, v = _tangents(direction)
    for c, s in _EIGHT:
        x, y, z = (d + step * (c * a + s * b) for d, a, b in zip(direction, u, v, strict=True))
        length = math.hypot(x, y, z)
        yield (x / length, y / length, z / length)


def _tangents(direction: Vector) -> tuple[Vector, Vector]:
    least = min(range(3), key=lambda i: abs(direction[i]))
    other = (float(least == 0), float(least == 1), float(least == 2))
    u = _cross(direction, other)
    length = math.hypot(*u)
    u = (u[0] / length, u[1] / length, u[2] / length)
    return u, _cross(direction, u)


def _both_ways(directions: Sequence[Vector]) -> Iterator[Vector]:
    for x, y, z in directions:
        yield (x, y, z)
        yield (-x, -y, -z)


def _columns(rotation: Rotation) -> list[Vector]:
    return [(rotation[0][i], rotation[1][i], rotation[2][i]) for i in range(3)]


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _fibonacci(number: int) -> Iterator[Vector]:
    """Yield directions spread evenly over the sphere."""
    golden = math.pi * (3 - math.sqrt(5))
    for i in range(number):
        z = 1 - (2 * i + 1) / number
        radius = math.sqrt(1 - z * z)
        yield (radius * math.cos(golden * i), radius * math.sin(golden * i), z)


_SPHERE = tuple(_fibonacci(_AROUND))
_EIGHT = tuple((math.cos(i * math.pi / 4), math.sin(i * math.pi / 4)) for i in range(8))
