"""Commands over time, as corners of straight lines: the output of a velocity limiter."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.locomotion.locomotion import MotionLimits
from checker.source.text import Located

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Knots = tuple[tuple[float, float], ...]
"""Corners of a line over time: seconds, and a value in the unit of what it commands."""

_FASTEST = 1e4
"""rad/s or m/s at most, of whatever turns or slides: beyond it, numbers overflow in a step."""


class Limits(Record):
    """Limits of a velocity limiter, as gz-math's SpeedLimiter.

    Attributes:
        slowest: Least velocity (negative), m/s or rad/s.
        fastest: Greatest velocity.
        braking: Least acceleration (negative), m/s² or rad/s².
        speeding: Greatest acceleration.
    """

    slowest: float = -math.inf
    fastest: float = math.inf
    braking: float = -math.inf
    speeding: float = math.inf

    @classmethod
    def from_plugin(cls, stated: MotionLimits) -> Limits:
        """Take the limits of a plugin; what it does not state, or states as no number, is none."""
        return cls(
            -_bound(stated.min_velocity, -1),
            _bound(stated.max_velocity, 1),
            -_bound(stated.min_acceleration, -1),
            _bound(stated.max_acceleration, 1),
        )

    @property
    def acceleration(self) -> float:
        """The lesser of both accelerations, as an amount."""
        return min(self.speeding, -self.braking)

    def clamp(self, velocity: float) -> float:
        """Return a velocity within the limits."""
        return max(self.slowest, min(velocity, self.fastest))


def _bound(stated: Located[float] | None, sign: int) -> float:
    """Return how far a limit lets go in the direction of a sign; 0 if it allows nothing."""
    if stated is None or math.isnan(stated.value):
        return math.inf
    return max(sign * stated.value, 0.0)


def ramp_to(targets: Iterable[tuple[float, float, float, float]], limits: Limits) -> Knots:
    """Follow targets as fast as limits allow.

    Args:
        targets: Start and end (seconds), velocity, and greatest acceleration as an amount.
        limits: The limits of the plugin that is commanded.
    """
    knots: list[tuple[float, float]] = []
    value = 0.0
    for start, end, target, rate in targets:
        knots.append((start, value))
        goal = limits.clamp(target)
        up = goal > value
        slope = min(rate, limits.speeding if up else -limits.braking)
        needed = abs(goal - value) / slope if slope > 0.0 else math.inf
        if needed <= end - start:
            knots.append((start + needed, goal))
            value = goal
        else:
            value += (slope if up else -slope) * (end - start)
        knots.append((end, value))
    return tuple(knots)


def value_at(knots: Knots, time: float) -> float:
    """Return the value of a line at a time, where it jumps the one after; its ends reach on."""
    return _interpolated(knots, bisect_right(knots, time, key=lambda knot: knot[0]), time)


def value_before(knots: Knots, time: float) -> float:
    """Return the value of a line at a time, where it jumps the one before; its ends reach on."""
    right = bisect_left(knots, time, key=lambda knot: knot[0])
    if right < len(knots) and knots[right][0] == time:
        return knots[right][1]
    return _interpolated(knots, right, time)


def _interpolated(knots: Knots, right: int, time: float) -> float:
    """Return the value between two corners, of which the right one is given by its number."""
    if right == 0:
        return knots[0][1] if knots else 0.0
    if right == len(knots):
        return knots[-1][1]
    (t0, v0), (t1, v1) = knots[right - 1], knots[right]
    return v0 + (v1 - v0) * (time - t0) / (t1 - t0)


def mix_lines(lines: Sequence[Knots], mix: Callable[..., float], step: float = math.inf) -> Knots:
    """Return a function of several lines as a line.

    Args:
        lines: Its arguments.
        mix: Takes one value of each; NaN and values without measure are cut.
        step: Seconds between corners where the function is not linear.
    """
    times = sorted({time for line in lines for time, _ in line})
    if times and math.isfinite(step):
        start, count = times[0], math.ceil((times[-1] - times[0]) / step)
        times = sorted({*times, *(start + step * number for number in range(count))})
    knots: list[tuple[float, float]] = []
    for time in times:
        for read in (value_before, value_at):
            corner = (time, _sane(mix(*(read(line, time) for line in lines))))
            if not knots or knots[-1] != corner:
                knots.append(corner)
    return tuple(knots)


def _sane(value: float) -> float:
    return 0.0 if math.isnan(value) else max(-_FASTEST, min(value, _FASTEST))


FASTEST_OF_SMOOTH = 1.875
"""Greatest speed of a motion of least jerk / its mean speed."""


def smoothed(knots: Knots, times: Array) -> tuple[Array, Array, Array]:
    """Return values at some times, their rates and accelerations, without jerks between corners.

    They rest at each corner. Source: the motion of least jerk, Flash and Hogan, 1985.
    """
    import numpy as np

    corners = np.array(knots)
    moments, values = corners[:, 0], corners[:, 1]
    before = np.clip(np.searchsorted(moments, times, side="right") - 1, 0, len(moments) - 2)
    length, step = np.diff(moments)[before], np.diff(values)[before]
    share = np.clip((times - moments[before]) / length, 0.0, 1.0)
    way = share**3 * (10.0 + share * (6.0 * share - 15.0))
    rate = 30.0 * share**2 * (1.0 - share) ** 2
    gain = 60.0 * share * (1.0 - share) * (1.0 - 2.0 * share)
    return values[before] + step * way, step / length * rate, step / length**2 * gain
