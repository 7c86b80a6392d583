"""The first screen: what to do first, and the result of the trial in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.record import Record
from checker.base.words import and_list, count, plain, shortened
from checker.finding import Severity
from checker.report.figures import NOT_JUDGED, Row, rows_of
from checker.report.html.findings import anchor_of, in_order
from checker.report.importance import by_rule
from checker.report.report import PackageReport, VerdictKind

FIRST = 3
"""Things to do that are named first."""
_TEXT_LIMIT = 300
_ROWS_SHOWN = 3


class Task(Record):
    """Something to do.

    Attributes:
        severity: Empty for a rule that was not checked.
        anchor: The anchor of the finding, or of the part of the page with details.
        where: The place; may be empty.
        more: Further findings of the same rule and severity.
    """

    severity: str
    message: str
    anchor: str
    where: str
    more: int


def first_tasks(package: PackageReport) -> list[Task]:
    """Return the most important things to do, each of another rule."""
    tasks = list(_findings(package))
    if package.verdict is VerdictKind.INCOMPLETE:
        tasks[:0] = _unseen(package)
    return tasks[:FIRST]


def _findings(package: PackageReport) -> Iterator[Task]:
    counting = [each for each in in_order(package.findings) if each.severity is not Severity.INFO]
    for first, *others in by_rule(counting):
        place = first.places[0]
        yield Task(
            str(first.severity),
            plain(shortened(first.message, _TEXT_LIMIT)),
            anchor_of(first),
            plain(f"{place.file}:{place.line}" if place.file else ""),
            len(others),
        )


def _unseen(package: PackageReport) -> Iterator[Task]:
    """Yield what keeps rules from looking that may hide an error, one task in all."""
    spots = [spot for spot in package.blind_spots if spot.may_hide_error]
    rules = len({spot.rule for spot in spots})
    reasons = and_list(list(dict.fromkeys(spot.reason for spot in spots))[:2])
    message = f"{count(rules, 'rule')} could not run: {reasons}"
    yield Task("", plain(shortened(message, _TEXT_LIMIT)), "not-checked", "", 0)


def trial_sentences(
    trial: Mapping[str, Any], name: str = "the robot", unseen: str = ""
) -> list[str]:
    """Return the result of a trial as sentences.

    Args:
        trial: The trial, as in `PackageReport.trial`.
        name: What the robot is called.
        unseen: The reasons why rules on trials were not checked; empty if all were.
    """
    if trial["refused"]:
        return [f"MuJoCo refuses the model: {plain(shortened(trial['refused'], _TEXT_LIMIT))}."]
    rows = rows_of(trial["measurements"])
    open_ones = [row for row in rows if row.rule.startswith("TRI") and row.verdict == NOT_JUDGED]
    # A trial without a verdict shows what is wrong with the model, not how the robot drives.
    unjudged = bool(unseen and open_ones)
    done = [] if unjudged else list(_done(_TrialFigures(trial)))
    sentences = [f"In MuJoCo {name} {and_list(done)}."] if done else []
    if trial.get("not_driven"):
        why = plain(shortened(trial["not_driven"], _TEXT_LIMIT))
        sentences.append(f"It was not driven: {why}.")
    sentences += [f"It {plain(shortened(each, _TEXT_LIMIT))}." for each in trial["trouble"]]
    if unjudged:
        are = "figure is" if len(open_ones) == 1 else "figures are"
        sentences.append(f"{len(open_ones)} {are} not judged: {unseen}.")
    return [*sentences, *_judged(rows)]


class _TrialFigures(Record):
    """A trial with access to its figures."""

    trial: Mapping[str, Any]

    def value(self, name: str) -> float | None:
        found = (each["value"] for each in self.trial["measurements"] if each["name"] == name)
        return next(found, None)

    def leg(self, name: str) -> Mapping[str, float]:
        return next((leg for leg in self.trial["course"] if leg["name"] == name), {})


def _done(figures: _TrialFigures) -> Iterator[str]:
    yield from _driven(figures)
    yield from _flown(figures)
    if figures.leg("hold"):
        sag, tilt = figures.value("hold_sag"), figures.value("hold_tilt")
        yield "stands" if sag is None and tilt is not None else "holds its pose"
    if figures.trial.get("moved"):
        yield f"moves {plain(shortened(figures.trial['moved'], _TEXT_LIMIT))}"


def _driven(figures: _TrialFigures) -> Iterator[str]:
    share, speed = figures.value("speed_ratio"), figures.leg("drive").get("linear", 0.0)
    if share is not None:
        yield f"drives at {_figure(share * speed)} m/s ({speed:.3g} commanded)"
    way = figures.value("stop_distance")
    if way is not None:
        yield f"stops within {_figure(way)} m"
    turned, rate = figures.value("yaw_rate"), figures.leg("turn").get("angular", 0.0)
    if turned is not None:
        yield f"turns at {_figure(turned)} rad/s ({rate:.3g} commanded)"
    fastest = figures.value("full_speed")
    if fastest is not None:
        yield f"reaches {_figure(fastest)} m/s at full speed"


def _flown(figures: _TrialFigures) -> Iterator[str]:
    effort, climbed = figures.value("hover_effort"), figures.value("climbed")
    if effort is not None:
        yield f"hovers with {effort:.0%} of its rotors' greatest thrust"
    if climbed is not None:
        yield f"climbs {_figure(climbed)} m (1 commanded)"


def _figure(value: float) -> str:
    """Write a figure with two or three digits; what is next to nothing is 0."""
    return f"{round(value, 3) + 0.0:.3g}"


def _judged(rows: list[Row]) -> Iterator[str]:
    judged = [row for row in rows if row.verdict != NOT_JUDGED]
    faults = [row for row in judged if row.is_fault]
    if faults:
        named = [
            f"{row.label} {row.value}" + (f" ({row.limits})" if row.limits else "")
            for row in faults[:_ROWS_SHOWN]
        ]
        more = f"; and {len(faults) - _ROWS_SHOWN} more" if len(faults) > _ROWS_SHOWN else ""
        figures = "; ".join(named)
        yield f"Outside their limits, {len(faults)} of {len(judged)} figures: {figures}{more}."
    elif judged:
        all_of_them = f"All {len(judged)} figures that rules judge are within their limits."
        one = "The one figure that a rule judges is within its limits."
        yield one if len(judged) == 1 else all_of_them
