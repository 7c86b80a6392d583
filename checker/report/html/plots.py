"""Plots of a trial: curves over time, the legs of the course, limits and scales."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from checker.base.record import Record
from checker.report.html.scale import Named, Values, extent, known_values, scale_of
from checker.report.html.themes import Course, Leg, Theme, themes_of

_LINES_SHOWN = 8


class Curve(Record):
    """One curve.

    Attributes:
        kind: `measured`, `command` or `limit`.
        hue: Number of its colour; curves of one number belong together.
    """

    name: str
    kind: str
    hue: int
    values: tuple[float | None, ...]


class Plot(Record):
    """Curves of one unit.

    Attributes:
        note: The way the figures were made and what the scale leaves out, as sentences.
        low: The start of the axis.
        high: The end of the axis.
    """

    title: str
    unit: str
    note: str
    low: float
    high: float
    curves: tuple[Curve, ...]


class TrialPlots(Record):
    """The plots of a trial over one axis of time."""

    time: tuple[float, ...]
    legs: tuple[Leg, ...]
    plots: tuple[Plot, ...]

    @property
    def json(self) -> str:
        """All of it as the page's script reads it."""
        return msgspec.json.encode(self).decode()


def plots_of(trial: Mapping[str, Any], mass: float | None = None) -> TrialPlots | None:
    """Return the plots of a trial; None if there are no samples.

    Args:
        trial: The trial, as in `PackageReport.trial`.
        mass: The mass of the robot, kg, where it is known.
    """
    moments = trial["series"].get("time") or ()
    legs = tuple(Leg(leg["name"], leg["start"], leg["end"]) for leg in trial["course"])
    if not legs or any(moment is None for moment in moments) or len(moments) < 2:
        return None
    course = Course(trial, tuple(moments), legs, mass)
    drawn = (_plot(theme) for theme in themes_of(course))
    plots = tuple(plot for plot in drawn if plot is not None)
    return TrialPlots(course.time, legs, plots) if plots else None


def _plot(theme: Theme) -> Plot | None:
    curves = [
        (name, values) for name, values in theme.measured if any(True for _ in known_values(values))
    ]
    if not curves:
        return None
    shown = _greatest(curves)
    limits = [
        (name, values) for name, values in theme.limits if any(True for _ in known_values(values))
    ]
    scale = scale_of(shown, theme.command, limits, theme.floor)
    notes = [theme.note] if theme.note else []
    if len(curves) > len(shown):
        notes.append(f"{len(curves) - len(shown)} parts of lower values are not drawn.")
    if scale.peak:
        notes.append(f"A peak of {scale.peak:.3g} {theme.unit} is beyond the scale.")
    beyond = sorted({extent([values]) for _, values in limits if not scale.holds(values)})
    if beyond:
        shown_limits = " and ".join(f"{limit:.3g}" for limit in beyond[:2])
        notes.append(f"Beyond the scale: the limit of {shown_limits} {theme.unit}.")
    drawn = [_curve(name, "measured", hue, values) for hue, (name, values) in enumerate(shown)]
    if any(value is not None for value in theme.command):
        drawn.append(_curve("commanded", "command", 0, theme.command))
    for hue, name in enumerate(dict.fromkeys(name for name, _ in limits)):
        drawn += [
            _curve(name, "limit", hue, values)
            for own, values in limits
            if own == name and scale.holds(values)
        ]
    return Plot(theme.title, theme.unit, " ".join(notes), scale.low, scale.high, tuple(drawn))


def _curve(name: str, kind: str, hue: int, values: Values) -> Curve:
    return Curve(name, kind, hue, tuple(v if v is None else float(f"{v:.4g}") for v in values))


def _greatest(curves: list[Named]) -> list[Named]:
    """Return the curves with the greatest values, in their own order."""
    ranked = sorted(range(len(curves)), key=lambda n: -extent([curves[n][1]]))
    return [curves[number] for number in sorted(ranked[:_LINES_SHOWN])]
