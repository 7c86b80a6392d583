"""Figures of a robot in words: numbers with units, counts of parts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from checker.base.record import Record
from checker.base.words import count
from checker.finding import Severity

# The figures of a trial as rows of a table: one for each name, of whatever parts.


HEADLINES = (
    *("settle_drop", "settle_tilt", "rest_penetration"),
    *("speed_ratio", "path_sideways", "path_heading", "stop_speed"),
    *("yaw_of_predicted", "turn_drift", "full_speed"),
    *("load_share", "torque"),
    *("thrust_to_weight", "hover_effort", "climbed"),
    *("hold_sag", "hold_tilt"),
    *("move_error", "move_torque"),
)
"""Figures that are shown when all is well; others only when a rule objects."""

_SEVERITIES = tuple(map(str, Severity))
_UNNAMED = ("", "rad or m")
"""Units of figures that have none, or one of two."""
NOT_JUDGED = "not judged"
"""The verdict on a figure that no rule judged."""
_GRAVITY = (*_SEVERITIES, "ok", NOT_JUDGED)


class Row(Record):
    """The figures of one name.

    Attributes:
        label: What was measured.
        value: The value with its unit; least to greatest of several parts.
        verdict: The most severe verdict; `ok` only if all parts have it.
        limits: The limits of the rule that judges them, in words.
        rule: Its id; empty for figures that only inform.
        parts: The number of parts it was measured for.
        matters: Whether it is shown when there is little room.
    """

    label: str
    value: str
    verdict: str
    limits: str
    rule: str
    parts: int
    matters: bool

    @property
    def is_fault(self) -> bool:
        """True if a rule reports it."""
        return self.verdict in _SEVERITIES


_ALIKE = 0.01
"""Share up to which the figures of several parts are shown as one."""


def rows_of(measurements: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Return the rows of a trial, in its order; `PackageReport.trial` holds the figures."""
    by_name: dict[str, list[Mapping[str, Any]]] = {}
    for measurement in measurements:
        by_name.setdefault(measurement["name"], []).append(measurement)
    return [_row(name, figures) for name, figures in by_name.items()]


def worst_verdict(verdicts: Iterable[str]) -> str:
    """Return the most severe of some verdicts; `not judged` of none."""
    return min(verdicts, key=_GRAVITY.index, default=NOT_JUDGED)


def _row(name: str, figures: Sequence[Mapping[str, Any]]) -> Row:
    first = figures[0]
    values = [figure["value"] for figure in figures]
    low, high = min(values), max(values)
    ends = [low, high] if high - low > _ALIKE * abs(high) else [high]
    shown = dict.fromkeys(_number(value, first["unit"]) for value in ends)
    unit = "°" if first["unit"] == "rad" else first["unit"] if first["unit"] not in _UNNAMED else ""
    joint = "" if unit in ("", "°") else " "
    verdicts = [str(figure["verdict"]) for figure in figures]
    verdict = worst_verdict(verdicts)
    if verdict == "ok" and NOT_JUDGED in verdicts:
        verdict = NOT_JUDGED
    return Row(
        label=first["label"],
        value=f"{'…'.join(shown)}{joint}{unit}",
        verdict=verdict,
        limits=limits_in_words(name, first["limits"], first["unit"]),
        rule=first["rule"],
        parts=len(figures),
        matters=name in HEADLINES or verdict in _SEVERITIES,
    )


_BEYOND_ONE = ("warning_beyond", "error_beyond")
_MOST = ("above", "warning_above", "error_above", "warning", "depth", "most_thrust")
_LEAST = ("below", "warning_below", "least_thrust")
_ERRORS = {"error": "above", "error_below": "below", "error_below_command": "below"}
"""Limits behind which a warning becomes an error, and on which side that is."""
_SHARES = {
    "full_speed": "the velocity limit",
    "full_acceleration": "the acceleration limit",
    "torque": "the effort limit",
    "move_torque": "the effort limit",
    "error_below_command": "the command",
}
"""Figures, or limits, that are compared with another figure instead of a number."""


def limits_in_words(name: str, limits: Mapping[str, float], unit: str) -> str:
    """Return what a rule allows: `ok up to 0.02; error above 0.1`."""
    least, most = allowed(limits)
    bounds = [f"from {_limit(name, least, unit)}"] if least is not None else []
    upto = "to" if bounds else "up to"
    bounds += [f"{upto} {_limit(name, most, unit)}"] if most is not None else []
    phrases = [f"ok {' '.join(bounds)}"] if bounds else []
    if len(of_one := [limits[key] for key in _BEYOND_ONE if key in limits]) > 1:
        phrases.append(f"error below {1 - of_one[1]:g} and above {1 + of_one[1]:g}")
    phrases += [
        f"error {side} {_limit(name if name in _SHARES else key, limits[key], unit)}"
        for key, side in _ERRORS.items()
        if key in limits
    ]
    return "; ".join(phrases)


def allowed(limits: Mapping[str, float]) -> tuple[float | None, float | None]:
    """Return the least and the greatest value that a rule does not report, where it has them."""
    off = next((limits[key] for key in _BEYOND_ONE if key in limits), None)
    if off is not None:
        return 1 - off, 1 + off
    least = next((limits[key] for key in _LEAST if key in limits), None)
    most = next((limits[key] for key in _MOST if key in limits), None)
    return least, most


def _limit(name: str, value: float, unit: str) -> str:
    """Write a limit; of what is no angle, some are shares of another figure."""
    if name in _SHARES:
        return _SHARES[name] if value == 1.0 else f"{value:g} × {_SHARES[name]}"
    if unit == "rad":
        return f"{math.degrees(value):.3g}°"
    return f"{value:g}{f' {unit}' if unit not in _UNNAMED else ''}"


def _number(value: float, unit: str) -> str:
    """Write a figure with three digits and four places, angles in degrees."""
    shown = math.degrees(value) if unit == "rad" else value
    return f"{round(shown, 4) + 0.0:.3g}"


_SAID_ELSEWHERE = ("not_driven",)
"""Facts that reports show with the trial."""
UNITS = {"kg": "kg", "m": "m", "deg": "°", "s": "s"}
"""Units by the ends of the names of facts: `mass_kg`."""


class Fact(Record):
    """Something known.

    Attributes:
        name: `mass`.
        value: The value with its unit: `18.5 kg`.
        phrase: Both together as one states it: `mass 18.5 kg`, `8 joints`.
    """

    name: str
    value: str
    phrase: str


def facts_in_words(facts: Mapping[str, Any]) -> Iterator[Fact]:
    """Yield the facts of a report that can be stated in a few words."""
    for name, value in facts.items():
        words, _, unit = name.rpartition("_")
        if unit in UNITS and isinstance(value, float | list):
            yield _stated(words.replace("_", " "), f"{_quantity(words, value)} {UNITS[unit]}")
        elif isinstance(value, float):
            yield _stated(name.replace("_", " "), f"{value:.3g}")
        elif isinstance(value, int):
            noun = name.replace("_", " ")
            yield Fact(noun, str(value), count(value, noun.removesuffix("s")))
        elif isinstance(value, str) and name not in _SAID_ELSEWHERE:
            noun = name.replace("_", " ")
            # "no drive detected" needs no "drive" in front.
            yield Fact(noun, value, value if f" {noun} " in value else f"{noun} {value}")


def _stated(name: str, value: str) -> Fact:
    return Fact(name, value, f"{name} {value}")


def _quantity(name: str, value: float | list[float]) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    numbers = [f"{round(number, 3) + 0.0:g}" for number in value]
    return " × ".join(numbers) if name == "size" else f"({', '.join(numbers)})"
