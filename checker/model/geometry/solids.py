"""Shapes as bodies of even density, by closed formulas."""

from __future__ import annotations

import math
from collections.abc import Sequence

from checker.model.geometry.bodies import Body, together
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform
from checker.model.mesh import Mesh, Meshes, mesh_of


def solid_of(geometry: Geometry, meshes: Meshes) -> Body | None:
    """Return a shape as a volume; None for shapes without end and meshes that are not known.

    A mesh that is not closed counts by its convex hull.
    """
    size = {name: tuple(number.value for number in sizes) for name, sizes in geometry.sizes.items()}
    body: Body | None = None
    match geometry.shape:
        case "box":
            a, b, c = size["size"]
            body = _upright(a * b * c, a * a / 12, b * b / 12, c * c / 12)
        case "sphere":
            (radius,) = size["radius"]
            body = _ellipsoid(radius, radius, radius)
        case "ellipsoid":
            body = _ellipsoid(*size["radii"])
        case "cylinder":
            body = _cylinder(size["radius"][0], size["length"][0])
        case "capsule":
            body = _capsule(size["radius"][0], size["length"][0])
        case "cone":
            radius, length = size["radius"][0], size["length"][0]
            across = radius * radius * 3 / 20
            volume = math.pi * radius * radius * length / 3
            body = _upright(volume, across, across, length * length * 3 / 80, -length / 4)
        case "mesh":
            mesh = mesh_of(geometry, meshes)
            body = _scaled(mesh.solid, size["scale"]) if isinstance(mesh, Mesh) else None
    return body if body is not None and math.isfinite(body.amount) else None


def _upright(volume: float, xx: float, yy: float, zz: float, z: float = 0.0) -> Body:
    spread = ((xx, 0.0, 0.0), (0.0, yy, 0.0), (0.0, 0.0, zz))
    return Body(volume, (0.0, 0.0, z), spread)


def _ellipsoid(a: float, b: float, c: float) -> Body:
    return _upright(4 / 3 * math.pi * a * b * c, a * a / 5, b * b / 5, c * c / 5)


def _cylinder(radius: float, length: float) -> Body:
    across = radius * radius / 4
    return _upright(math.pi * radius * radius * length, across, across, length * length / 12)


def _capsule(radius: float, length: float) -> Body | None:
    """Return a cylinder with half a ball at each end."""
    square = radius * radius
    middle = 3 / 8 * radius
    halves = [
        _upright(
            2 / 3 * math.pi * square * radius,
            square / 5,
            square / 5,
            square / 5 - middle * middle,
            side * (length / 2 + middle),
        )
        for side in (1, -1)
    ]
    return together([_cylinder(radius, length), *halves])


def _scaled(body: Body, scale: Sequence[float]) -> Body:
    """Return a mesh stretched along its axes."""
    a, b, c = scale
    stretch = Transform(((a, 0.0, 0.0), (0.0, b, 0.0), (0.0, 0.0, c)))
    spread = (stretch @ Transform(body.spread) @ stretch).rotation
    return Body(body.amount * abs(a * b * c), stretch.rotate(body.centre), spread)
