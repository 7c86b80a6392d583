"""The robots of a package, each with its facts, its trial and the trial's verdict."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from checker.base.record import Record
from checker.report.figures import rows_of, worst_verdict
from checker.report.report import PackageReport


class TrialVerdict(Record):
    """The result of a trial.

    Attributes:
        word: `ok`, `info`, `warning`, `error`; `not judged`; `not driven`; empty without a trial.
        reason: The reason why it was not driven; may be empty.
    """

    word: str
    reason: str = ""

    def __str__(self) -> str:
        """Return both in words."""
        return f"{self.word}: {self.reason}" if self.reason else self.word


class ReportedRobot(Record):
    """One robot of a package.

    Attributes:
        number: 0 for the first.
        facts: What is known of it.
        trial: What was driven and measured; None if nothing was.
    """

    number: int
    facts: Mapping[str, Any]
    trial: Mapping[str, Any] | None

    @property
    def name(self) -> str:
        """Name of the robot, or of a scene without one."""
        return str(self.facts.get("robot") or self.facts.get("scene", ""))

    @property
    def file(self) -> str:
        """The file that describes it; empty if the package has one robot."""
        return str(self.facts.get("file", ""))

    @property
    def verdict(self) -> TrialVerdict:
        """The result of its trial."""
        if self.trial is None:
            why_not = str(self.facts.get("not_driven", ""))
            return TrialVerdict("not driven" if why_not else "", why_not)
        if self.trial["refused"]:
            return TrialVerdict("error", "MuJoCo refuses the model")
        word = worst_verdict(row.verdict for row in rows_of(self.trial["measurements"]))
        why_not = str(self.trial.get("not_driven", ""))
        faultless = word in ("ok", "not judged")
        return TrialVerdict("not driven", why_not) if why_not and faultless else TrialVerdict(word)

    @property
    def is_object(self) -> bool:
        """True if it has no joint, sensor or plugin: a barrel of a world, not a robot."""
        counts = [self.facts.get(name) for name in ("joints", "sensors", "plugins")]
        return counts == [0, 0, 0]


def robots_of(package: PackageReport) -> list[ReportedRobot]:
    """Return the robots of a package; one without facts where nothing is known of any."""
    trials = {trial.get("robot", 0): trial for trial in package.other_trials}
    if package.trial is not None:
        trials[package.trial.get("robot", 0)] = package.trial
    facts = (package.facts, *package.other_robots)
    return [ReportedRobot(number, known, trials.get(number)) for number, known in enumerate(facts)]
