"""How much room a shape takes, and how far it reaches from a point: closed formulas."""

from __future__ import annotations

import math

from checker.model.mesh import Mesh, Meshes, mesh_of
from checker.model.shapes import Geometry
from checker.model.transform import Transform, Vector


def volume_of(geometry: Geometry, meshes: Meshes) -> float | None:
    """Return the volume of a shape, m³; None for shapes without end and meshes that are not known.

    A mesh that is not closed counts by its convex hull.
    """
    size = {name: tuple(each.value for each in sizes) for name, sizes in geometry.sizes.items()}
    volume: float | None = None
    match geometry.shape:
        case "box":
            volume = math.prod(size["size"])
        case "sphere":
            volume = 4 / 3 * math.pi * size["radius"][0] ** 2 * size["radius"][0]
        case "cylinder":
            volume = math.pi * size["radius"][0] * size["radius"][0] * size["length"][0]
        case "capsule":
            radius, length = size["radius"][0], size["length"][0]
            volume = math.pi * radius * radius * (length + 4 / 3 * radius)
        case "cone":
            volume = math.pi * size["radius"][0] * size["radius"][0] * size["length"][0] / 3
        case "ellipsoid":
            volume = 4 / 3 * math.pi * math.prod(size["radii"])
        case "mesh":
            mesh = mesh_of(geometry, meshes)
            if isinstance(mesh, Mesh):
                own = abs(mesh.volume) if mesh.watertight and mesh.volume else mesh.hull_volume
                volume = own * abs(math.prod(size["scale"]))
    return volume if volume is None or math.isfinite(volume) else None


def farthest(geometry: Geometry, pose: Transform, point: Vector, meshes: Meshes) -> float | None:
    """Return the distance of a point from the farthest point of a shape, metres.

    None as for `volume_of`.

    Args:
        geometry: The shape.
        pose: Of the shape, in the frame of `point`.
        point: From where to measure.
        meshes: Of the robot.
    """
    size = {name: tuple(each.value for each in sizes) for name, sizes in geometry.sizes.items()}
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
