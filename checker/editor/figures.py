"""Figures as a hover shows them: four digits, with their units."""

from __future__ import annotations

import math
from collections.abc import Iterable

from checker.model.geometry.transform import Transform

_LARGE = 1e4
_NOISE = 1e-9
"""Metres and radians that rounding leaves behind."""


def number(value: float) -> str:
    """Return a number with four digits, whole ones in full: `0.3333`, `12500`."""
    if not math.isfinite(value):
        return str(value)
    if (value == round(value) and abs(value) < 1e15) or abs(value) >= _LARGE:
        return f"{value:.0f}" if abs(value) < 1e15 else f"{value:.3e}"
    return f"{value:.4g}"


def numbers(values: Iterable[float], unit: str = "") -> str:
    """Return numbers with blanks between them, and a unit behind."""
    text = " ".join(number(0.0 if abs(value) < _NOISE else value) for value in values)
    return f"{text} {unit}" if unit else text


def angle(radians: float) -> str:
    """Return an angle in radians and in degrees."""
    return f"{number(radians)} rad ({number(round(math.degrees(radians), 2))}°)"


def span_of(low: float, high: float, unit: str, *, turns: bool = False) -> str:
    """Return limits: `-1.5 to 1.5 rad (-85.94° to 85.94°)`; `no limit` without any.

    Args:
        low: The lower one; −inf for none.
        high: The upper one; inf for none.
        unit: The unit of both.
        turns: Whether they are angles in radians, which degrees are added to.
    """
    if math.isinf(low) and math.isinf(high):
        return "no limit"
    text = f"{_bound(low)} to {_bound(high)} {unit}"
    if not turns:
        return text
    degrees = (f"{_bound(round(math.degrees(value), 2))}°" for value in (low, high))
    return f"{text} ({' to '.join(degrees)})"


def _bound(value: float) -> str:
    return number(value) if math.isfinite(value) else "∞" if value > 0 else "−∞"


def limit(value: float, unit: str) -> str:
    """Return a limit with its unit; `no limit` for one at infinity."""
    return f"{number(value)} {unit}" if math.isfinite(value) else "no limit"


def pose(transform: Transform) -> str:
    """Return a pose: metres, and roll, pitch, yaw in degrees where it turns."""
    place = numbers(transform.translation, "m")
    angles = [0.0 if abs(it) < _NOISE else round(math.degrees(it), 3) for it in transform.rpy]
    return f"{place}, roll pitch yaw {numbers(angles)}°" if any(angles) else place


def size(count: int) -> str:
    """Return a file's size."""
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1000:.3g} kB" if count < 1_000_000 else f"{count / 1e6:.3g} MB"
