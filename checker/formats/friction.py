"""The friction that a collision states."""

from __future__ import annotations

import math

from checker.base.record import Record
from checker.formats.urdf.extensions import extension_number
from checker.model.components import Collision, Link
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.values import numbers_of_words, stated_number
from checker.source.text import Located
from checker.source.xml import Element


class Friction(Record, eq=False):
    """Coefficients of sliding friction; None if they are left to the physics engine.

    Attributes:
        first: Along the first friction direction (`mu`, URDF `mu1`).
        second: Across it (`mu2`).
        direction: The first friction direction in the frame of the collision (`fdir1`), of any
            length; None for the world's axes.
    """

    first: Located[float] | None = None
    second: Located[float] | None = None
    direction: Vector | None = None


_SDF = (("ode", "mu", "mu2"), ("bullet", "friction", "friction2"))


class FrictionReader:
    """Reads friction: of SDF in `<surface>`, of URDF in `<gazebo reference="link">`."""

    def __init__(self, robot: Robot) -> None:
        self.extensions: dict[str, list[Element]] = {}
        tag = robot.conventions.extension_tag
        for element in robot.element.all(tag) if tag else ():
            self.extensions.setdefault(element.get("reference") or "", []).append(element)

    def friction_of(self, link: Link, collision: Collision) -> Friction:
        """Return what is stated for a collision; the first engine that states anything counts."""
        stated = collision.element.child("surface", "friction")
        for engine, first, second in _SDF:
            element = stated.child(engine) if stated is not None else None
            if element is not None:
                along = _direction(element.child("fdir1"))
                return Friction(
                    stated_number(element, first), stated_number(element, second), along
                )
        for element in self.extensions.get(link.scoped_name, ()):
            first_number = extension_number(element, "mu1")
            if first_number is not None:
                along = _direction(element.child("fdir1"))
                return Friction(first_number, extension_number(element, "mu2"), along)
        return Friction()


def _direction(element: Element | None) -> Vector | None:
    """Return the direction that an element states; None for zeros and for what is no direction."""
    match numbers_of_words(element.text.value) if element is not None else []:
        case [float(x), float(y), float(z)] if 0.0 < math.hypot(x, y, z) < math.inf:
            return (x, y, z)
    return None
