"""Themes of the plots of a trial: speed, tilt, loads and others, and their limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from msgspec import field

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.report.figures import allowed
from checker.report.html.scale import Named, Values

_CLIMB = "climb"
"""The leg of a copter whose command is the rate of its height."""
_FULL = "full speed"
"""The leg that the table's torque leaves out."""
_PLACED = "hover"
"""The leg at whose start a copter is put into the air."""
_ALLOWED = ("least allowed", "most allowed")
_EFFORTS_SHOWN = 8
_NAME_LIMIT = 60
_GRAVITY = 9.8


class Leg(Record):
    """A leg of the course, seconds."""

    name: str
    start: float
    end: float


class Course(Record):
    """A trial in the form that the plots need."""

    trial: Mapping[str, Any]
    time: tuple[float, ...]
    legs: tuple[Leg, ...]
    mass: float | None

    def series(self, name: str) -> Values:
        """Return samples by name; none if there are none."""
        values: Values = self.trial["series"].get(name, ())
        return values

    def figures(self, name: str) -> list[Mapping[str, Any]]:
        """Return what was measured under a name, part by part."""
        return [each for each in self.trial["measurements"] if each["name"] == name]

    def value(self, name: str) -> float | None:
        """Return the first of these figures."""
        return next((figure["value"] for figure in self.figures(name)), None)

    def bounds(self, name: str) -> tuple[float | None, float | None]:
        """Return what the rule of a figure allows, least and most."""
        return next((allowed(figure["limits"]) for figure in self.figures(name)), (None, None))

    def during(self, name: str, value: float | None) -> Values:
        """Return a value in a leg, and nothing outside."""
        leg = next((leg for leg in self.legs if leg.name == name), None)
        if leg is None or value is None:
            return ()
        return [value if leg.start <= moment < leg.end else None for moment in self.time]

    def always(self, value: float) -> Values:
        """Return a value at every moment."""
        return [value] * len(self.time)


class Theme(Record):
    """A plot before its scale is chosen.

    Attributes:
        floor: The least that the axis spans.
    """

    title: str
    unit: str
    measured: list[Named]
    floor: float
    command: Values = ()
    limits: list[Named] = field(default_factory=list)
    note: str = ""


def _driving(course: Course) -> Theme:
    command = course.series("command_linear")
    limits: list[Named] = []
    for name, share in zip(_ALLOWED, course.bounds("speed_ratio"), strict=True):
        leg = course.during("drive", share)
        limits.append((name, [_times(a, b) for a, b in zip(leg, command, strict=False)]))
    fastest = course.value("full_speed_limit")
    if fastest is not None:
        limits.append(("velocity limit", course.always(fastest)))
    speed = [("measured", course.series("speed"))]
    return Theme("Speed", "m/s", speed, 0.02, command, limits)


def _climbing(course: Course) -> Theme:
    """Return the rate of height, which is a multicopter's command (`Leg.linear`)."""
    placed = next((leg.start for leg in course.legs if leg.name == _PLACED), math.inf)
    rates = _rates(course.time, course.series("z"), placed)
    command = course.series("command_linear")
    note = f"At {placed:g} s the copter is put into the air; that jump is left out."
    return Theme(
        "Climb rate", "m/s", [("measured", rates)], 0.02, command,
        note=note if math.isfinite(placed) else "",
    )  # fmt: skip


def _rates(time: Sequence[float], values: Values, placed: float) -> Values:
    """Return how fast a value changes from each sample to the next, `placed` left out."""
    rates: list[float | None] = []
    for (start, value), (end, after) in pairwise(zip(time, values, strict=False)):
        if value is None or after is None or end <= start or start < placed <= end:
            rates.append(None)
        else:
            rates.append((after - value) / (end - start))
    return rates


def themes_of(course: Course) -> Iterator[Theme]:
    """Yield the items to draw."""
    climbs = any(leg.name == _CLIMB for leg in course.legs)
    yield _climbing(course) if climbs else _driving(course)
    turning = [("measured", course.series("yaw_rate"))]
    command = course.series("command_angular")
    yield Theme("Turn rate", "rad/s", turning, 0.02, command, list(_turn_limits(course)))
    roll, pitch = _degrees(course.series("roll")), _degrees(course.series("pitch"))
    tilt = [("roll", roll), ("pitch", pitch)]
    yield Theme("Tilt", "°", tilt, 1.0, limits=list(_tilt_limits(course)))
    height = [("robot", course.series("z"))]
    yield Theme("Height", "m", height, 0.05, limits=list(_height_limits(course)))
    loads = _parts(course, "load:")
    yield Theme("Load on the ground", "N", loads, 1.0, limits=list(_load_limits(course)))
    full = ", which leaves full speed out" if any(leg.name == _FULL for leg in course.legs) else ""
    yield Theme(
        "Torque", "N·m", _parts(course, "torque:"), 0.05, limits=list(_torque_limits(course)),
        note=f"Mean over 0.1 s, as in the table{full}.",
    )  # fmt: skip


def _turn_limits(course: Course) -> Iterator[Named]:
    predicted = course.value("yaw_predicted")
    least, _ = course.bounds("yaw_of_predicted")
    yield "predicted", course.during("turn", predicted)
    yield _ALLOWED[0], course.during("turn", _times(least, predicted))


def _tilt_limits(course: Course) -> Iterator[Named]:
    for leg in ("settle", "hover", "hold"):
        _, most = course.bounds(f"{leg}_tilt")
        for sign in (1.0, -1.0):
            limit = _times(sign, None if most is None else math.degrees(most))
            yield _ALLOWED[1], course.during(leg, limit)


def _height_limits(course: Course) -> Iterator[Named]:
    """Yield how far it may sink from the height at the start of a leg."""
    for leg in course.legs:
        _, most = course.bounds("settle_drop" if leg.name == "settle" else f"{leg.name}_sink")
        start = next(
            (z for t, z in zip(course.time, course.series("z"), strict=False) if t >= leg.start),
            None,
        )
        if most is not None and start is not None:
            yield _ALLOWED[0], course.during(leg.name, start - most)


def _load_limits(course: Course) -> Iterator[Named]:
    wheels = len(course.figures("load_share"))
    least, _ = course.bounds("load_share")
    if wheels and least is not None and course.mass is not None:
        share = course.mass * _GRAVITY / wheels
        yield "equal share", course.during("settle", share)
        yield _ALLOWED[0], course.during("settle", least * share)


def _torque_limits(course: Course) -> Iterator[Named]:
    efforts = {figure["value"] for figure in course.figures("torque_limit")}
    for effort in sorted(efforts)[:_EFFORTS_SHOWN]:
        for sign in (1.0, -1.0):
            yield "effort limit", course.always(sign * effort)


def _parts(course: Course, prefix: str) -> list[Named]:
    return [
        (plain(shortened(name.removeprefix(prefix), _NAME_LIMIT)), values)
        for name, values in course.trial["series"].items()
        if name.startswith(prefix)
    ]


def _times(one: float | None, other: float | None) -> float | None:
    return None if one is None or other is None else one * other


def _degrees(values: Values) -> Values:
    return [None if value is None else math.degrees(value) for value in values]
