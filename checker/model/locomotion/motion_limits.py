"""Limits of velocity and acceleration that drive plugins set."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from checker.base.record import Record
from checker.model.components import UNLIMITED, Plugin
from checker.model.locomotion.locomotion import (
    Locomotion,
    MotionLimits,
    TrackedDrive,
    WheelDrive,
)
from checker.model.values import stated_number
from checker.source.text import Located, Span
from checker.source.xml import Element

# Reads the motion limits of drive plugins.


def read_limits(element: Element, kind: str = "") -> MotionLimits:
    """Read `min_velocity` and the like.

    Args:
        element: The element that contains them.
        kind: `linear_` or `angular_`: `min_linear_velocity`, where stated, counts instead.
    """

    def number(end: str, quantity: str) -> Located[float] | None:
        own = stated_number(element, f"{end}_{kind}{quantity}") if kind else None
        return own or stated_number(element, f"{end}_{quantity}")

    return MotionLimits(
        element.span,
        number("min", "velocity"),
        number("max", "velocity"),
        number("min", "acceleration"),
        number("max", "acceleration"),
    )


def limits_below(holder: Element, tag: str) -> MotionLimits:
    """Read the limits in a child of a plugin; without that child, there are none."""
    child = holder.child(tag)
    return MotionLimits(holder.span) if child is None else read_limits(child)


def symmetric_limits(
    holder: Span, velocity: Located[float] | None, acceleration: Located[float] | None
) -> MotionLimits:
    """Return limits that are the same both ways."""
    return MotionLimits(holder, _negated(velocity), velocity, _negated(acceleration), acceleration)


def _negated(number: Located[float] | None) -> Located[float] | None:
    return None if number is None else Located(-number.value, number.span)


Kind = Literal["linear", "angular"]
Ends = tuple[Located[float] | None, Located[float] | None]


class BoundedMotion(Record, eq=False):
    """One motion of a robot and its limits.

    Attributes:
        plugin: The drive plugin.
        kind: Along the axis, or about it.
        axis: The axis of the robot: `x`, `y` or `z`.
        limits: The limits as the plugin states them.
        both_kinds: Whether one figure bounds the linear and the angular motion alike: what it
            states about the angular one may not be meant.
        flies: Whether the plugin is that of a multicopter.
    """

    plugin: Plugin
    kind: Kind
    axis: str
    limits: MotionLimits
    both_kinds: bool = False
    flies: bool = False

    @property
    def name(self) -> str:
        """Name in messages: `x linear`."""
        return f"{self.axis} {self.kind}"

    @property
    def velocity(self) -> Ends:
        """Smallest and greatest velocity, m/s or rad/s."""
        return self.limits.min_velocity, self.limits.max_velocity

    @property
    def acceleration(self) -> Ends:
        """Smallest and greatest acceleration, m/s² or rad/s²."""
        return self.limits.min_acceleration, self.limits.max_acceleration

    @property
    def quantities(self) -> tuple[tuple[str, str, Ends], ...]:
        """Velocity and acceleration, each with its name and unit."""
        unit = "m/s" if self.kind == "linear" else "rad/s"
        return (
            ("velocity", unit, self.velocity),
            ("acceleration", f"{unit}²", self.acceleration),
        )


def bounded_motions(locomotion: Locomotion) -> Iterator[BoundedMotion]:
    """Yield what the drive plugins bound: x and the turn about z, of a multicopter all axes."""
    drives: tuple[WheelDrive | TrackedDrive, ...] = (
        *(drive for drive in locomotion.wheel_drives if not drive.diameter_tag),
        *locomotion.tracked_drives,
    )
    for drive in drives:
        # Those of Gazebo Classic have no limits, controllers of ros2_control have others.
        if isinstance(drive.plugin, Plugin):
            both = _same(drive.linear.max_velocity, drive.angular.max_velocity)
            yield BoundedMotion(drive.plugin, "linear", "x", drive.linear)
            yield BoundedMotion(drive.plugin, "angular", "z", drive.angular, both)
    for copter in locomotion.copters:
        for axis, limits in zip("xyz", copter.linear, strict=True):
            yield BoundedMotion(copter.plugin, "linear", axis, limits, flies=True)
        for axis, limits in zip("xyz", copter.angular, strict=True):
            yield BoundedMotion(copter.plugin, "angular", axis, limits, flies=True)


def is_unlimited(number: Located[float]) -> bool:
    """Return whether a limit is so large that it means that there is none."""
    return not abs(number.value) < UNLIMITED


def _same(one: Located[float] | None, other: Located[float] | None) -> bool:
    """Return whether two figures are one text."""
    if one is None or other is None or one.span.source is not other.span.source:
        return False
    return (one.span.start, one.span.end) == (other.span.start, other.span.end)
