"""The wheels that WheelSlip plugins list."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.model.values import stated_number
from checker.source.text import Located, Span


class SlippingWheel(Record, eq=False):
    """One `<wheel>` of a WheelSlip plugin.

    Attributes:
        plugin: The WheelSlip.
        link: Scoped name of the link that it means; empty if it names none.
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
        for wheel in plugin.element.all("wheel"):
            name = wheel.attribute("link_name")
            yield SlippingWheel(
                plugin,
                "" if name is None else plugin.scoped(name.value),
                stated_number(wheel, "slip_compliance_lateral"),
                stated_number(wheel, "wheel_normal_force"),
                stated_number(wheel, "wheel_radius"),
                wheel.span,
            )
