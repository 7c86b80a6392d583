"""Reads the motion limits of drive plugins."""

from __future__ import annotations

from checker.model.locomotion.locomotion import MotionLimits
from checker.model.values import stated_number
from checker.source.text import Located, Span
from checker.source.xml import Element


def read_limits(element: Element, kind: str = "") -> MotionLimits:
    """Read `min_velocity` and the like.

    Args:
        element: What holds them.
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
