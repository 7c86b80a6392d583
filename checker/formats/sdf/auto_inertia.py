"""Mass and inertia that SDF 1.11 computes from collisions: `<inertial auto="true">`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from checker.model.components import Collision, Inertial, Pose
from checker.model.geometry.bodies import Body, together
from checker.model.geometry.solids import solid_of
from checker.model.geometry.transform import Transform, Vector
from checker.model.mesh import NoMeshes
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

_WATER = 1000.0
"""kg/m³, where neither the collision nor the inertial states a density."""


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
    body = together([body for body in bodies if body is not None])
    stated = values.number(element, "mass", body.amount if body is not None else math.nan)
    if body is None or None in bodies:
        return _inertial(element, math.nan, (0.0, 0.0, 0.0), (math.nan,) * 6)
    return _inertial(element, stated.value, body.centre, body.moments(stated.value))


def _bodies(collisions: Iterable[Collision], usual: float) -> Iterator[Body | None]:
    for collision in collisions:
        solid = solid_of(collision.geometry, NoMeshes())
        if solid is None or collision.pose.relative_to:
            yield None
            continue
        density = ValueReader().number(collision.element, "density", usual).value
        yield solid.times(density).placed(collision.pose.transform)


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
