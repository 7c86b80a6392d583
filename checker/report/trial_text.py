"""The trial for a person at a terminal: one line for each figure that matters."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.finding import Severity
from checker.report.palette import Palette
from checker.report.wording import count, plain, shortened

HEADLINES = (
    *("settle_drop", "settle_tilt", "rest_penetration"),
    *("speed_ratio", "path_sideways", "path_heading", "stop_speed"),
    *("yaw_of_predicted", "turn_drift", "full_speed"),
    *("load_share", "torque"),
    *("thrust_to_weight", "hover_effort", "climbed"),
    *("hold_sag", "hold_tilt"),
)
"""Figures that are shown when all is well; others only when a rule objects."""

_GRAVITY = (*map(str, Severity), "ok", "not judged")
_TEXT_LIMIT = 300
_NOTES_SHOWN = 3


def trial_text(trial: Mapping[str, Any], palette: Palette) -> Iterator[str]:
    """Yield the lines of the table, and what was left out of the trial.

    Args:
        trial: As `PackageReport.trial` has it.
        palette: Colours.
    """
    if trial["refused"]:
        yield plain(f"trial: MuJoCo does not take the model: {_short(trial['refused'])}")
        return
    yield plain(f"trial: {_course(trial)}")
    rows = [_row(figures) for figures in _shown(trial["measurements"])]
    widths = [max((len(row[column]) for row in rows), default=0) for column in range(3)]
    for row in rows:
        label, value, verdict = (
            plain(text).ljust(width) for text, width in zip(row, widths, strict=False)
        )
        yield f"    {label}  {value}  {_coloured(verdict, palette)}  {row[3]}".rstrip()
    for note in trial["notes"][:_NOTES_SHOWN]:
        yield plain(f"    note: {_short(note)}")
    if trial["repairs"]:
        repaired = count(len(trial["repairs"]), "repair")
        first = trial["repairs"][0]
        yield plain(f"    {repaired} so that it could go on: {_short(_repair(first))}")


def _course(trial: Mapping[str, Any]) -> str:
    seconds = max((leg["end"] for leg in trial["course"]), default=0.0)
    version = trial["versions"].get("mujoco", "")
    return f"{trial['drive']}, {seconds:g} s in MuJoCo {version}".rstrip()


def _repair(repair: Mapping[str, Any]) -> str:
    return f"{repair['part']} {repair['what']}"


def _shown(measurements: Sequence[Mapping[str, Any]]) -> list[list[Mapping[str, Any]]]:
    """Join the figures of one name, and keep those that matter in the order of the trial."""
    by_name: dict[str, list[Mapping[str, Any]]] = {}
    for each in measurements:
        by_name.setdefault(each["name"], []).append(each)
    return [
        figures
        for name, figures in by_name.items()
        if name in HEADLINES or _gravest(figures) in list(Severity)
    ]


def _row(figures: Sequence[Mapping[str, Any]]) -> tuple[str, str, str, str]:
    """Return label, value (least to greatest of several parts), verdict and limits."""
    first = figures[0]
    values = [each["value"] for each in figures]
    ends = dict.fromkeys(_number(value, first["unit"]) for value in (min(values), max(values)))
    unit = {"rad": "°", "rad or m": ""}.get(first["unit"], first["unit"])
    joint = "" if unit in ("", "°") else " "
    limits = _limits(first) if _gravest(figures) in list(Severity) else ""
    return first["label"], f"{'…'.join(ends)}{joint}{unit}", _gravest(figures), limits


def _gravest(figures: Sequence[Mapping[str, Any]]) -> str:
    return str(min((each["verdict"] for each in figures), key=_GRAVITY.index))


def _limits(figure: Mapping[str, Any]) -> str:
    limits = figure["limits"].items()
    return ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in limits)


def _number(value: float, unit: str) -> str:
    """Write a figure with three digits and four places, angles in degrees."""
    shown = math.degrees(value) if unit == "rad" else value
    return f"{round(shown, 4) + 0.0:.3g}"


def _coloured(verdict: str, palette: Palette) -> str:
    word = verdict.strip()
    if word not in list(Severity):
        return verdict
    return palette.severity(Severity(word)) + verdict[len(word) :]


def _short(text: str) -> str:
    return shortened(text, _TEXT_LIMIT)
