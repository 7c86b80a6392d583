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
        frame_attribute: The name of the attribute of `fdir1` that gives another frame, where its
            value is written; None without one.
    """

    first: Located[float] | None = None
    second: Located[float] | None = None
    direction: Vector | None = None
    frame_attribute: Located[str] | None = None


FRAME_ATTRIBUTES = ("gz:expressed_in", "ignition:expressed_in")
"""The attributes of `fdir1` since Garden, and up to Fortress."""
_SDF = (("ode", "mu", "mu2"), ("bullet", "friction", "friction2"))


class FrictionReader:
    """Reads friction: of SDF in `<surface>`, of URDF in `<gazebo reference="link">`.

    Readers of URDF ignore a `<surface>` in the link itself.
    """

    def __init__(self, robot: Robot) -> None:
        self.is_urdf = robot.conventions.is_urdf
        self.extensions: dict[str, list[Element]] = {}
        tag = robot.conventions.extension_tag
        for element in robot.element.all(tag) if tag else ():
            self.extensions.setdefault(element.get("reference") or "", []).append(element)

    def friction_of(self, link: Link, collision: Collision) -> Friction:
        """Return what is stated for a collision; the first engine that states anything counts."""
        extensions = self.extensions.get(link.scoped_name, ())
        own = () if self.is_urdf else (collision.element,)
        for holder in (*own, *(it.child("collision") for it in extensions)):
            if holder is not None and (stated := holder.child("surface", "friction")):
                return _of_surface(stated)
        for element in extensions:
            first_number = extension_number(element, "mu1")
            if first_number is not None:
                return _friction(first_number, extension_number(element, "mu2"), element)
        return Friction()


def _of_surface(stated: Element) -> Friction:
    for engine, first, second in _SDF:
        element = stated.child(engine)
        if element is not None:
            numbers = (stated_number(element, first), stated_number(element, second))
            return _friction(*numbers, element)
    return Friction()


def _friction(
    first: Located[float] | None, second: Located[float] | None, element: Element
) -> Friction:
    """Return the friction of two coefficients, with the `fdir1` beside them."""
    along = element.child("fdir1")
    if along is None:
        return Friction(first, second)
    frames = ((name, along.attribute(name)) for name in FRAME_ATTRIBUTES)
    frame = next((Located(name, it.span) for name, it in frames if it is not None), None)
    return Friction(first, second, _direction(along), frame)


def _direction(element: Element) -> Vector | None:
    """Return the direction that an element states; None for zeros and for what is no direction."""
    match numbers_of_words(element.text.value):
        case [float(x), float(y), float(z)] if 0.0 < math.hypot(x, y, z) < math.inf:
            return (x, y, z)
    return None
