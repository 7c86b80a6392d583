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
        frame_attribute: The attribute of `fdir1` that names another frame, if any.
    """

    first: Located[float] | None = None
    second: Located[float] | None = None
    direction: Vector | None = None
    frame_attribute: Located[str] | None = None


FRAME_ATTRIBUTES = ("gz:expressed_in", "ignition:expressed_in")
"""The attributes of `fdir1` since Garden, and up to Fortress."""
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
        extensions = self.extensions.get(link.scoped_name, ())
        for holder in (collision.element, *(it.child("collision") for it in extensions)):
            if holder is not None and (stated := holder.child("surface", "friction")):
                return _of_surface(stated)
        for element in extensions:
            first_number = extension_number(element, "mu1")
            if first_number is not None:
                along = element.child("fdir1")
                second_number = extension_number(element, "mu2")
                return Friction(first_number, second_number, _direction(along), _frame(along))
        return Friction()


def _of_surface(stated: Element) -> Friction:
    for engine, first, second in _SDF:
        element = stated.child(engine)
        if element is not None:
            along = element.child("fdir1")
            numbers = (stated_number(element, first), stated_number(element, second))
            return Friction(*numbers, _direction(along), _frame(along))
    return Friction()


def _frame(direction: Element | None) -> Located[str] | None:
    """Return the attribute that names the frame of a direction: its name, at its value."""
    for name in FRAME_ATTRIBUTES if direction is not None else ():
        written = direction.attribute(name) if direction is not None else None
        if written is not None:
            return Located(name, written.span)
    return None


def _direction(element: Element | None) -> Vector | None:
    """Return the direction that an element states; None for zeros and for what is no direction."""
    match numbers_of_words(element.text.value) if element is not None else []:
        case [float(x), float(y), float(z)] if 0.0 < math.hypot(x, y, z) < math.inf:
            return (x, y, z)
    return None
