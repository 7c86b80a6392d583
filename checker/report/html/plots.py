"""Plots of a trial as SVG paths; the page adds words, axes and the moment that is shown."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from checker.base.record import Record
from checker.base.words import plain, shortened

WIDTH, HEIGHT = 1000.0, 100.0
"""Of a plot's own units; the page stretches them to whatever room there is."""
_CLIMB = "climb"
"""The leg of a copter whose command is the rate of its height."""
_LINES_SHOWN = 8
_MARGIN = 0.08
"""Share of the range that is left free above and below."""

Values = Sequence[float | None]


class Line(Record):
    """One curve: its name and its points, as SVG's `points` has them, piece by piece."""

    name: str
    style: str
    pieces: tuple[str, ...]


class Tick(Record):
    """A value on the axis, and how far down it stands, in per cent."""

    value: str
    top: float


class Plot(Record):
    """Curves of one unit over the time of a trial.

    Attributes:
        zero: Where zero stands, in the plot's units; None outside.
        more: Curves that are not shown.
    """

    title: str
    unit: str
    lines: tuple[Line, ...]
    ticks: tuple[Tick, ...]
    zero: float | None
    more: int


class Span(Record):
    """A leg of the course: its name, where it starts and how long it is, in per cent."""

    name: str
    start: float
    width: float


def spans_of(course: Sequence[Mapping[str, Any]]) -> list[Span]:
    """Return the legs of a course on the time axis."""
    end = max((leg["end"] for leg in course), default=0.0)
    if end <= 0.0:
        return []
    return [
        Span(
            leg["name"],
            round(100 * leg["start"] / end, 3),
            round(100 * (leg["end"] - leg["start"]) / end, 3),
        )
        for leg in course
    ]


def plots_of(trial: Mapping[str, Any]) -> list[Plot]:
    """Return the plots of a trial; `PackageReport.trial` holds the series."""
    series, course = trial["series"], trial["course"]
    time = series.get("time") or ()
    end = max((leg["end"] for leg in course), default=0.0)
    if not time or end <= 0.0:
        return []
    climbs = any(leg["name"] == _CLIMB for leg in course)
    themes = (_climbing(series) if climbs else _driving(series), *_themes(series))
    drawn = (_plot(title, unit, curves, time, end) for title, unit, curves in themes)
    return [plot for plot in drawn if plot.lines]


_Curves = list[tuple[str, str, Values]]
"""Name, style and values of each."""


_Theme = tuple[str, str, _Curves]
"""Title, unit and curves of a plot."""


def _driving(series: Mapping[str, Values]) -> _Theme:
    return "Speed", "m/s", _pair(series.get("command_linear", ()), series.get("speed", ()))


def _climbing(series: Mapping[str, Values]) -> _Theme:
    """Return the rate of height, which is what a copter is told (`Leg.linear`)."""
    rates = _rates(series.get("time", ()), series.get("z", ()))
    return "Climb rate", "m/s", _pair(series.get("command_linear", ()), rates)


def _rates(time: Values, values: Values) -> Values:
    """Return how fast a value changes from each sample to the next."""
    rates: list[float | None] = []
    for (start, value), (end, after) in pairwise(zip(time, values, strict=False)):
        if start is None or end is None or value is None or after is None or end <= start:
            rates.append(None)
        else:
            rates.append((after - value) / (end - start))
    return rates


def _themes(series: Mapping[str, Values]) -> Iterator[_Theme]:
    turning = _pair(series.get("command_angular", ()), series.get("yaw_rate", ()))
    yield "Turn rate", "rad/s", turning
    roll, pitch = _degrees(series.get("roll", ())), _degrees(series.get("pitch", ()))
    yield "Tilt", "°", [("roll", "line-0", roll), ("pitch", "line-1", pitch)]
    yield "Height", "m", [("robot", "line-0", series.get("z", ()))]
    yield "Load on the ground", "N", _parts(series, "load:")
    yield "Torque", "N·m", _parts(series, "torque:")


def _pair(command: Values, reached: Values) -> _Curves:
    # The command is drawn last: dashes on top of a curve leave both to be seen.
    return [("reached", "line-0", reached), ("commanded", "command", command)]


def _parts(series: Mapping[str, Values], prefix: str) -> _Curves:
    names = [name for name in series if name.startswith(prefix)]
    return [
        (plain(shortened(name.removeprefix(prefix), 60)), f"line-{number % 8}", series[name])
        for number, name in enumerate(names)
    ]


def _degrees(values: Values) -> Values:
    return [None if value is None else math.degrees(value) for value in values]


def _plot(title: str, unit: str, curves: _Curves, time: Values, end: float) -> Plot:
    curves = [curve for curve in curves if any(value is not None for value in curve[2])]
    shown = curves[:_LINES_SHOWN]
    low, high = _range([values for _, _, values in shown])
    lines = tuple(
        Line(name, style, tuple(_pieces(time, values, end, low, high)))
        for name, style, values in shown
    )
    zero = _down(0.0, low, high) if low < 0.0 < high else None
    return Plot(title, unit, lines, _ticks(low, high), zero, len(curves) - len(shown))


def _range(curves: Sequence[Values]) -> tuple[float, float]:
    """Return what the axis spans: all values and some room, never less than can be told apart."""
    values = [value for curve in curves for value in curve if value is not None]
    low, high = min(values, default=0.0), max(values, default=1.0)
    low, high = (min(low, 0.0), max(high, 0.0)) if _near_zero(low, high) else (low, high)
    room = max((high - low) * _MARGIN, 0.01)
    return low - room, high + room


def _near_zero(low: float, high: float) -> bool:
    """Say whether zero is near enough to be shown."""
    return min(abs(low), abs(high)) < 2 * (high - low) or low * high <= 0.0


def _ticks(low: float, high: float) -> tuple[Tick, ...]:
    """Return two or three round values on the axis; none where figures are beyond all bounds."""
    if not 0.0 < high - low < math.inf:
        return ()
    step = 10 ** math.floor(math.log10((high - low) / 2))
    step *= next((factor for factor in (5, 2) if (high - low) / (step * factor) >= 2), 1)
    first = math.ceil(low / step)
    values = [number * step for number in range(first, math.floor(high / step) + 1)]
    return tuple(
        Tick(f"{value + 0.0:.4g}", round(_down(value, low, high), 2)) for value in values[:6]
    )


def _down(value: float, low: float, high: float) -> float:
    return HEIGHT * (high - value) / (high - low)


def _pieces(time: Values, values: Values, end: float, low: float, high: float) -> Iterator[str]:
    """Yield a curve's points; where a value is missing, another piece begins."""
    points: list[str] = []
    for moment, value in zip(time, values, strict=False):
        if moment is None or value is None:
            if points:
                yield " ".join(points)
            points = []
        else:
            points.append(f"{WIDTH * moment / end:.1f},{_down(value, low, high):.1f}")
    if points:
        yield " ".join(points)
