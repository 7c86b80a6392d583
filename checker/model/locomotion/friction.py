"""The friction that a collision states."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Collision, Link, Plugin
from checker.model.robot import Robot
from checker.model.urdf.extensions import extension_number
from checker.model.values import stated_number
from checker.source.text import Located, Span
from checker.source.xml import Element

if TYPE_CHECKING:
    from checker.model.robot import Robot


# What WheelSlip plugins say about the wheels of a robot.


class SlippingWheel(Record, eq=False):
    """One `<wheel>` of a WheelSlip plugin.

    Attributes:
        plugin: The WheelSlip.
        link: Scoped name of the link that it means; empty when it names none.
        lateral: Slip compliance across the wheel; None if not stated.
        normal_force: Newtons; None if not stated.
        radius: Metres; None if not stated.
        span: The element.
    """

    plugin: Plugin
    link: str
    lateral: Located[float] | None
    normal_force: Located[float] | None
    radius: Located[float] | None
    span: Span


def slipping_wheels(robot: Robot) -> Iterator[SlippingWheel]:
    """Yield the wheels that WheelSlip plugins list, also those that do not exist."""
    for plugin in robot.all_plugins:
        if plugin.class_name != "WheelSlip":
            continue
        scope = f"{plugin.nested_in}::" if plugin.nested_in else ""
        for wheel in plugin.element.all("wheel"):
            name = wheel.attribute("link_name")
            yield SlippingWheel(
                plugin,
                "" if name is None else scope + name.value,
                stated_number(wheel, "slip_compliance_lateral"),
                stated_number(wheel, "wheel_normal_force"),
                stated_number(wheel, "wheel_radius"),
                wheel.span,
            )


class Friction(Record, eq=False):
    """Coefficients of sliding friction; None where they are left to the physics engine.

    Attributes:
        first: Along the first friction direction (`mu`, URDF `mu1`).
        second: Across it (`mu2`).
    """

    first: Located[float] | None = None
    second: Located[float] | None = None


_SDF = (("ode", "mu", "mu2"), ("bullet", "friction", "friction2"))


class FrictionReader:
    """Reads friction: of SDF in `<surface>`, of URDF in `<gazebo reference="link">`."""

    def __init__(self, robot: Robot) -> None:
        self.extensions: dict[str, list[Element]] = {}
        if robot.format == "urdf":
            for element in robot.element.all("gazebo"):
                self.extensions.setdefault(element.get("reference") or "", []).append(element)

    def of(self, link: Link, collision: Collision) -> Friction:
        """Return what is stated for a collision; the first engine that says anything counts."""
        stated = collision.element.child("surface", "friction")
        for engine, first, second in _SDF:
            element = stated.child(engine) if stated is not None else None
            if element is not None:
                return Friction(stated_number(element, first), stated_number(element, second))
        for element in self.extensions.get(link.scoped_name, ()):
            first_number = extension_number(element, "mu1")
            if first_number is not None:
                return Friction(first_number, extension_number(element, "mu2"))
        return Friction()
