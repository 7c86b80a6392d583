"""The batteries of a robot, and how long they last in Gazebo Dome."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.base.resources import table
from checker.model.components import Plugin
from checker.source.text import Located, Span
from checker.source.xml import XmlDocument

if TYPE_CHECKING:
    from checker.model.robot import Robot

BATTERY_CLASS = "LinearBatteryPlugin"
RELEASE = "dome"
"""The release for whose plugin `Battery.minutes` is valid."""

MOVING_CLASSES = frozenset(
    {
        "AckermannSteering",
        "DiffDrive",
        "MecanumDrive",
        "MulticopterMotorModel",
        "MulticopterVelocityControl",
        "TrackController",
        "TrackedVehicle",
    }
)
"""Plugin classes that turn wheels, tracks and rotors."""

_TRUE = ("1", "true")
# Charge is counted in Ah, and Dome's plugin drains a hundred times as fast as its figures say:
# Ah * V / W are hours; 60 minutes an hour, a hundredth of it.
_MINUTES = 60.0 / 100.0


class Battery(Record, eq=False):
    """A LinearBatteryPlugin.

    Attributes:
        power_load: What drains it, watts; None if not stated.
        minutes: The time that a full charge lasts in Gazebo Dome; None if its figures do not state
            it.
        starts_on_motion: Whether `start_on_motion` is true.
        draining_topics: Topics whose first message makes it drain.
    """

    plugin: Plugin
    power_load: Located[float] | None
    minutes: float | None
    starts_on_motion: bool
    draining_topics: tuple[Located[str], ...]

    @property
    def span(self) -> Span:
        """The load, which decides how long it lasts; else the plugin."""
        return self.power_load.span if self.power_load is not None else self.plugin.span


def batteries(robot: Robot) -> tuple[Battery, ...]:
    """Return the batteries of a robot."""
    return tuple(_battery(plugin) for plugin in robot.plugins if plugin.class_name == BATTERY_CLASS)


def _battery(plugin: Plugin) -> Battery:
    return Battery(
        plugin,
        plugin.number("power_load"),
        _minutes(plugin),
        any(text.value.lower() in _TRUE for text in plugin.at("start_on_motion")),
        tuple(plugin.at("power_draining_topic")),
    )


def _minutes(plugin: Plugin) -> float | None:
    """Return how long the charge lasts at the mean voltage, minutes.

    The formula is fitted to accepted endurances (`subt_standards.json`); robots whose plugin states
    `fix_issue_225` drain as their figures state, and are left out.
    """
    charge = plugin.number("initial_charge") or plugin.number("capacity")
    numbers = (
        charge,
        plugin.number("open_circuit_voltage_constant_coef"),
        plugin.number("open_circuit_voltage_linear_coef"),
        plugin.number("power_load"),
    )
    if any(True for _ in plugin.at("fix_issue_225")) or None in numbers:
        return None
    ah, constant, linear, load = (number.value for number in numbers if number is not None)
    if load <= 0.0:
        return None
    calibration = float(table("subt_standards")["battery"]["formula"]["calibration"])
    minutes = calibration * _MINUTES * ah * (constant + linear / 2) / load
    return minutes if 0.0 < minutes < math.inf else None


def commented_out(documents: Iterable[XmlDocument], class_name: str) -> Iterator[Span]:
    """Yield where a plugin class is named within comments."""
    for document in documents:
        text = document.source.text
        start = text.find("<!--")
        while start >= 0:
            end = text.find("-->", start)
            end = len(text) if end < 0 else end
            at = text.find(f"::{class_name}", start, end)
            if at >= 0:
                yield Span(document.source, at + 2, at + 2 + len(class_name))
            start = text.find("<!--", end)
