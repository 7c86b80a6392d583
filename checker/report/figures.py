"""What is known of a robot, in words: figures with units, parts counted."""

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
)
"""Figures that are shown when all is well; others only when a rule objects."""

_SEVERITIES = tuple(map(str, Severity))
_GRAVITY = (*_SEVERITIES, "ok", "not judged")


class Row(Record):
    """The figures of one name.

    Attributes:
        label: What was measured.
        value: With its unit; least to greatest of several parts.
        verdict: The gravest.
        limits: Of the rule that judges them, in words.
        rule: Its id; empty for figures that only inform.
        parts: How many parts it was measured for.
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
        """Whether a rule objects."""
        return self.verdict in _SEVERITIES


def rows_of(measurements: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Return the rows of a trial, in its order; `PackageReport.trial` holds the figures."""
    by_name: dict[str, list[Mapping[str, Any]]] = {}
    for measurement in measurements:
        by_name.setdefault(measurement["name"], []).append(measurement)
    return [_row(name, figures) for name, figures in by_name.items()]


def gravest(verdicts: Iterable[str]) -> str:
    """Return the gravest of some verdicts; `not judged` of none."""
    return min(verdicts, key=_GRAVITY.index, default="not judged")


def _row(name: str, figures: Sequence[Mapping[str, Any]]) -> Row:
    first = figures[0]
    values = [figure["value"] for figure in figures]
    ends = dict.fromkeys(_number(value, first["unit"]) for value in (min(values), max(values)))
    unit = {"rad": "°", "rad or m": ""}.get(first["unit"], first["unit"])
    joint = "" if unit in ("", "°") else " "
    verdict = gravest(str(figure["verdict"]) for figure in figures)
    return Row(
        label=first["label"],
        value=f"{'…'.join(ends)}{joint}{unit}",
        verdict=verdict,
        limits=", ".join(_limit(key, value, first["unit"]) for key, value in _limits(first)),
        rule=first["rule"],
        parts=len(figures),
        matters=name in HEADLINES or verdict in _SEVERITIES,
    )


def _limits(figure: Mapping[str, Any]) -> list[tuple[str, float]]:
    return list(figure["limits"].items())


def _limit(name: str, value: float, unit: str) -> str:
    """Return a limit in words; of what is no angle, some are shares of another figure."""
    words = name.replace("_", " ")
    return f"{words} {math.degrees(value):.3g}°" if unit == "rad" else f"{words} {value:g}"


def _number(value: float, unit: str) -> str:
    """Write a figure with three digits and four places, angles in degrees."""
    shown = math.degrees(value) if unit == "rad" else value
    return f"{round(shown, 4) + 0.0:.3g}"


_SAID_ELSEWHERE = ("not_driven",)
"""Facts that reports tell with the trial."""
UNITS = {"kg": "kg", "m": "m", "deg": "°", "s": "s"}
"""Units by the ends of the names of facts: `mass_kg`."""


class Fact(Record):
    """Something known.

    Attributes:
        name: `mass`.
        value: With its unit: `18.5 kg`.
        phrase: Both together as one says it: `mass 18.5 kg`, `8 joints`.
    """

    name: str
    value: str
    phrase: str


def facts_in_words(facts: Mapping[str, Any]) -> Iterator[Fact]:
    """Yield the facts of a report that can be said in a few words."""
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
            yield _stated(name.replace("_", " "), value)


def _stated(name: str, value: str) -> Fact:
    return Fact(name, value, f"{name} {value}")


def _quantity(name: str, value: float | list[float]) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    numbers = [f"{round(number, 3) + 0.0:g}" for number in value]
    return " × ".join(numbers) if name == "size" else f"({', '.join(numbers)})"
