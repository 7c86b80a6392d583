"""Mass and inertia that SDF 1.11 computes from collisions: `<inertial auto="true">`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from checker.model.components import Collision, Inertial, Pose
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

_WATER = 1000.0
"""kg/m³, where neither the collision nor the inertial states a density."""

Matrix = tuple[Vector, Vector, Vector]
_Body = tuple[float, Vector, Matrix]
"""Mass, centre, and moments about the centre, in the axes of the link."""


def is_automatic(inertial: Element | None) -> bool:
    """Return whether an `<inertial>` leaves its values to the simulator."""
    automatic = inertial.get("auto") if inertial is not None else None
    return (automatic or "").strip().lower() in ("1", "true")


def automatic_inertial(element: Element, collisions: Iterable[Collision]) -> Inertial:
    """Return what the simulator computes; a mass that is not a number where it needs a mesh.

    Args:
        element: The `<inertial>`.
        collisions: The collisions of the link.
    """
    values = ValueReader()
    usual = values.number(element, "density", _WATER).value
    bodies = list(_bodies(collisions, usual))
    known = [body for body in bodies if body is not None]
    total = math.fsum(mass for mass, _, _ in known)
    stated = values.number(element, "mass", total)
    if len(known) < len(bodies) or not total > 0.0:
        return _inertial(element, math.nan, (0.0, 0.0, 0.0), (math.nan,) * 6)
    scale = stated.value / total
    centre = _mean(known, total)
    moments = _moments_about(known, centre)
    return _inertial(element, stated.value, centre, tuple(scale * each for each in moments))


def _bodies(collisions: Iterable[Collision], usual: float) -> Iterator[_Body | None]:
    for collision in collisions:
        solid = _solid(collision.geometry)
        if solid is None or collision.pose.relative_to:
            yield None
            continue
        volume, squares = solid
        mass = volume * ValueReader().number(collision.element, "density", usual).value
        pose = collision.pose.transform
        yield mass, pose.translation, _turned(mass, squares, pose)


def _solid(geometry: Geometry) -> tuple[float, Vector] | None:
    """Return a shape's volume and its mean squares of x, y and z; None for one that is no solid."""
    size = {name: tuple(number.value for number in sizes) for name, sizes in geometry.sizes.items()}
    match geometry.shape:
        case "box":
            x, y, z = size["size"]
            return x * y * z, (x * x / 12, y * y / 12, z * z / 12)
        case "sphere":
            square = size["radius"][0] ** 2 / 5
            return 4 / 3 * math.pi * size["radius"][0] ** 3, (square, square, square)
        case "ellipsoid":
            a, b, c = size["radii"]
            return 4 / 3 * math.pi * a * b * c, (a * a / 5, b * b / 5, c * c / 5)
        case "cylinder":
            radius, length = size["radius"][0], size["length"][0]
            across = radius * radius / 4
            return math.pi * radius * radius * length, (across, across, length * length / 12)
    return None


def _turned(mass: float, squares: Vector, pose: Transform) -> Matrix:
    """Return the moments of a shape about its centre, in the axes of its link."""
    axes = [pose.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    trace = math.fsum(squares)

    def entry(row: int, column: int) -> float:
        spread = math.fsum(
            square * axis[row] * axis[column] for square, axis in zip(squares, axes, strict=True)
        )
        return mass * ((trace if row == column else 0.0) - spread)

    rows = [(entry(row, 0), entry(row, 1), entry(row, 2)) for row in range(3)]
    return rows[0], rows[1], rows[2]


def _mean(bodies: list[_Body], total: float) -> Vector:
    x, y, z = (math.fsum(mass * at[axis] for mass, at, _ in bodies) / total for axis in range(3))
    return x, y, z


def _moments_about(bodies: list[_Body], centre: Vector) -> tuple[float, ...]:
    """Return ixx, ixy, ixz, iyy, iyz, izz of all bodies about a point."""
    sums = []
    for row, column in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)):
        parts = []
        for mass, at, moments in bodies:
            arm = [a - b for a, b in zip(at, centre, strict=True)]
            square = math.fsum(each * each for each in arm) if row == column else 0.0
            parts.append(moments[row][column] + mass * (square - arm[row] * arm[column]))
        sums.append(math.fsum(parts))
    return tuple(sums)


def _inertial(
    element: Element, mass: float, centre: Vector, moments: tuple[float, ...]
) -> Inertial:
    span = element.span
    return Inertial(
        Pose(Transform.from_xyz_rpy(centre, (0.0, 0.0, 0.0)), "", (), span),
        Located(mass, span),
        tuple(Located(moment, span, stated=False) for moment in moments),
        span,
    )
