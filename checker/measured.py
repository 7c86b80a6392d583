"""A trial as the report shows it: every figure with its limits and a verdict."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from checker.engine import Outcome
from checker.finding import Place, Severity
from checker.trial.measures import MEASURES, Measure
from checker.trial.robot_trial import RobotTrial
from checker.trial.trial import Measurement, Trial

_JUDGES = frozenset(measure.rule for measure in MEASURES.values())
"""Rules that judge figures. They key each finding with the figures it is about."""

NOT_JUDGED = "not judged"
_SERIES_DIGITS = 6


def measured(driven: RobotTrial, outcome: Outcome) -> dict[str, Any]:
    """Return what JSON can express of a trial and of what the rules said about its figures."""
    trial = driven.trial
    said = replace(trial, replay=None).as_json()
    return {
        "drive": trial.drive,
        "versions": dict(trial.versions),
        "course": said["legs"],
        "refused": trial.refused,
        "refused_part": trial.refused_part,
        "measurements": list(_measurements(driven, outcome)),
        "repairs": said["repairs"],
        "notes": list(trial.notes),
        "trouble": list(trial.trouble),
        "series": _series(trial),
    }


def _measurements(driven: RobotTrial, outcome: Outcome) -> Iterator[dict[str, Any]]:
    verdicts = _verdicts(outcome)
    for each in driven.trial.measurements:
        measure = MEASURES.get(each.name, Measure(each.name.replace("_", " ")))
        if not math.isfinite(each.value):
            continue
        looked = measure.rule in outcome.looked
        yield {
            "name": each.name,
            "label": measure.label,
            "value": _rounded(each.value),
            "unit": measure.unit,
            "part": each.part,
            "other": each.other,
            "rule": measure.rule,
            "limits": _limits(each.name, outcome.looked.get(measure.rule, {})),
            "verdict": _verdict(each, driven, verdicts, looked),
        }


_Verdicts = dict[str, list[tuple[Severity, frozenset[tuple[str, int, int]]]]]
"""By the name of a figure: how grave each finding about it is, and where its places start."""


def _verdicts(outcome: Outcome) -> _Verdicts:
    verdicts: _Verdicts = {}
    # A figure is out of its limits also where that shall not count.
    aside = (each.finding for each in outcome.suppressed)
    for found in (*outcome.findings, *aside):
        if found.rule in _JUDGES or found.rule.startswith("TRI"):
            places = frozenset(map(_start, found.places))
            for name in found.key.split():
                verdicts.setdefault(name, []).append((found.severity, places))
    return verdicts


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _verdict(each: Measurement, driven: RobotTrial, verdicts: _Verdicts, looked: bool) -> str:
    """Return the gravest that was said about a figure; `ok` when its rule looked and was silent."""
    said = verdicts.get(each.name, [])
    if each.part:
        start = _start(driven.part(each.part).span.place())
        said = [(severity, places) for severity, places in said if start in places]
    if said:
        return str(min((severity for severity, _ in said), key=lambda severity: severity.rank))
    return "ok" if looked and MEASURES[each.name].silence_is_ok else NOT_JUDGED


def _limits(name: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options that are about a figure, without its name in front.

    A rule of several figures names its options after them, as `settle_tilt_above`.
    """
    own = {key: value for key, value in options.items() if key.startswith(f"{name}_")}
    if own:
        return {key.removeprefix(f"{name}_"): value for key, value in own.items()}
    return {key: value for key, value in options.items() if not _names_a_figure(key)}


def _names_a_figure(option: str) -> bool:
    return any(option.startswith(f"{name}_") for name in MEASURES)


def _series(trial: Trial) -> dict[str, list[float | None]]:
    return {
        name: [_rounded(value) if math.isfinite(value) else None for value in values]
        for name, values in trial.series.items()
    }


def _rounded(value: float) -> float:
    """Return a figure with as many digits as anybody can tell apart."""
    return float(f"{value:.{_SERIES_DIGITS}g}")
