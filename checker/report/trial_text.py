"""The trial for a person at a terminal: one line for each figure that matters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.finding import Severity
from checker.report.figures import rows_of
from checker.report.palette import Palette
from checker.report.wording import count, plain, shortened

_TEXT_LIMIT = 300
_NOTES_SHOWN = 3


def trial_text(trial: Mapping[str, Any], palette: Palette) -> Iterator[str]:
    """Yield the lines of the table, and what was left out of the trial.

    Args:
        trial: As `PackageReport.trial` has it.
        palette: Colours.
    """
    if trial["refused"]:
        yield plain(f"trial: MuJoCo refuses the model: {_short(trial['refused'])}")
        return
    yield plain(f"trial: {_course(trial)}")
    rows = [row for row in rows_of(trial["measurements"]) if row.matters]
    columns = [(row.label, row.value, row.verdict) for row in rows]
    widths = [max(map(len, column)) for column in zip(*columns, strict=True)]
    for row, texts in zip(rows, columns, strict=True):
        label, value, verdict = (
            plain(text).ljust(width) for text, width in zip(texts, widths, strict=True)
        )
        limits = row.limits if row.is_fault else ""
        yield f"    {label}  {value}  {_coloured(verdict, palette)}  {limits}".rstrip()
    for note in trial["notes"][:_NOTES_SHOWN]:
        yield plain(f"    note: {_short(note)}")
    if trial["repairs"]:
        repaired = count(len(trial["repairs"]), "repair")
        first = trial["repairs"][0]
        yield plain(f"    {repaired} to make the trial possible: {_short(_repair(first))}")


def _course(trial: Mapping[str, Any]) -> str:
    seconds = max((leg["end"] for leg in trial["course"]), default=0.0)
    version = trial["versions"].get("mujoco", "")
    return f"{trial['drive']}, {seconds:g} s in MuJoCo {version}".rstrip()


def _repair(repair: Mapping[str, Any]) -> str:
    return f"{repair['part']} {repair['what']}"


def _coloured(verdict: str, palette: Palette) -> str:
    word = verdict.strip()
    if word not in list(Severity):
        return verdict
    return palette.severity(Severity(word)) + verdict[len(word) :]


def _short(text: str) -> str:
    return shortened(text, _TEXT_LIMIT)
