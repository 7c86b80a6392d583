"""The scale of a plot: few far samples do not flatten the rest, and noise is not magnified."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record

Values = Sequence[float | None]
"""The values of a curve; None if there is none."""
Named = tuple[str, Values]
"""A curve with its name."""


class Scale(Record):
    """An axis.

    Attributes:
        low: The start of the scale.
        high: The end of the scale.
        peak: The value farthest beyond it; 0 if it holds all.
    """

    low: float
    high: float
    peak: float

    def holds(self, values: Values) -> bool:
        """Return whether a whole curve is on it."""
        return all(self.low <= value <= self.high for value in known_values(values))


def known_values(values: Values) -> Iterator[float]:
    """Yield the values that are there."""
    return (value for value in values if value is not None)


def extent(curves: Iterable[Values]) -> float:
    """Return the greatest distance from zero."""
    return max((abs(value) for values in curves for value in known_values(values)), default=0.0)


_RARE = 0.01
"""Share of the samples at either end that do not choose the scale if they lie far from the rest."""
_FAR = 0.5
"""Share of the axis from which on a sample is far from it."""
_LIMIT_IN_VIEW = 4.0
"""Factor of the greatest value: limits beyond are written, not drawn."""
_LIMIT_SHARE = 0.1
"""Share of the greatest limit that the axis spans at least, so that noise stays flat."""
_MARGIN = 0.06


def scale_of(
    measured: Sequence[Named], command: Values, limits: Sequence[Named], floor: float
) -> Scale:
    """Return the scale of a plot.

    Args:
        measured: The curves it is about, of which at least one has a value.
        command: The commanded value.
        limits: Drawn where they are near.
        floor: The least that the axis spans.
    """
    found = sorted(value for _, values in measured for value in known_values(values))
    rare = int(len(found) * _RARE)
    usual = (found[rare], found[-1 - rare], *known_values(command))
    low, high = min(usual), max(usual)
    bounds = [value for _, values in limits for value in known_values(values)]
    near = _LIMIT_IN_VIEW * max(abs(low), abs(high))
    drawn = [value for value in bounds if abs(value) <= near]
    low, high = min([low, *drawn]), max([high, *drawn])
    if min(abs(low), abs(high)) < 2 * (high - low):
        low, high = min(low, 0.0), max(high, 0.0)
    least = max(floor, _LIMIT_SHARE * max(map(abs, bounds), default=0.0))
    room = max((high - low) * _MARGIN, (least - (high - low)) / 2)
    low, high = low - room, high + room
    far = _FAR * (high - low)
    bottom, top = (low - found[0]), (found[-1] - high)
    low, high = low - bottom if 0 < bottom <= far else low, high + top if 0 < top <= far else high
    beyond = max(bottom, top) > far
    return Scale(low, high, max((found[0], found[-1]), key=abs) if beyond else 0.0)
