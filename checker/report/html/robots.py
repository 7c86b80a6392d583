"""The robots of a package and their trials, ready to be shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.finding import Severity
from checker.report.figures import Row, facts_in_words, rows_of
from checker.report.html.plots import TrialPlots, plots_of
from checker.report.report import PackageReport
from checker.report.robots import ReportedRobot, robots_of

_TEXT_LIMIT = 300
_BADGES = ("ok", *map(str, Severity))


class ShownRobot(Record):
    """One robot.

    Attributes:
        anchor: The anchor that links to its trial.
        in_view: Whether it is the one in 3D.
        badge: `ok` or a severity: the result of the trial; empty if it was not judged.
        verdict: The same in words, and why it was not driven.
        facts: Names and values.
        trial: The trial, as in `PackageReport.trial`; None if nothing was driven.
    """

    anchor: str
    in_view: bool
    name: str
    file: str
    mass: str
    links: str
    drive: str
    badge: str
    verdict: str
    facts: tuple[tuple[str, str], ...]
    trial: Mapping[str, Any] | None
    rows: tuple[Row, ...] = ()
    plots: TrialPlots | None = None

    @property
    def has_fault(self) -> bool:
        """True if a rule reports its trial."""
        return self.badge in map(str, Severity)

    @property
    def summary(self) -> str:
        """Most important facts about the robot."""
        known = dict(self.facts)
        phrases = [known[name] for name in ("drive", "mass", "size") if name in known]
        counted = ((name, known[name]) for name in ("links", "joints", "sensors") if name in known)
        phrases += [f"{number} {name[:-1] if number == '1' else name}" for name, number in counted]
        return ", ".join(phrases)


def shown_robots(package: PackageReport) -> list[ShownRobot]:
    """Return the robots of a package; the first is the one in 3D."""
    return [_shown_robot(robot) for robot in robots_of(package)]


def _shown_robot(robot: ReportedRobot) -> ShownRobot:
    facts = {plain(fact.name): plain(fact.value) for fact in facts_in_words(robot.facts)}
    verdict, trial = robot.verdict, robot.trial
    return ShownRobot(
        anchor=f"trial-{robot.number + 1}",
        in_view=robot.number == 0,
        name=_short(robot.name),
        file=_short(robot.file),
        mass=facts.get("mass", "–"),
        links=facts.get("links", "–"),
        drive=facts.get("drive", "–"),
        badge=verdict.word if verdict.word in _BADGES else "",
        verdict=_short(str(verdict)),
        facts=tuple(facts.items()),
        trial=trial,
        rows=tuple(rows_of(trial["measurements"])) if trial else (),
        plots=plots_of(trial, _mass(robot.facts)) if trial else None,
    )


def _mass(facts: Mapping[str, Any]) -> float | None:
    mass = facts.get("mass_kg")
    return float(mass) if isinstance(mass, int | float) else None


def files_out_of_view(robots: list[ShownRobot]) -> Iterator[str]:
    """Yield the files of robots that are not in 3D: their elements name nothing that is seen."""
    seen = {robot.file for robot in robots if robot.in_view}
    return (robot.file for robot in robots if robot.file not in seen)


def _short(text: str) -> str:
    return plain(shortened(text, _TEXT_LIMIT))
