"""When a robot is driven, and what is said when it is not."""

from __future__ import annotations

from typing import Any

import pytest

from checker.base.parts import NotAvailable, type_name
from checker.engine.judge import Judge
from checker.engine.run import Outcome, run_rules
from checker.finding import Severity
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.report.report import NO_TRIAL, Cause, NotChecked
from checker.rule import Concern, Findings, Rule, finding
from checker.settings import Settings
from tests.engine.stage import Wheel, at, rule_saying, subt


def of_trial(_: RobotTrial, *, limit: float = 1.0) -> Findings:
    yield finding(at(1), f"it fell over, {limit:g} m", key="settle_tilt")


def of_both(_: RepeatedTrial) -> Findings:
    yield finding(at(2), "the second time it did not")


ONCE = Rule("TRI902", "falls", Severity.ERROR, Concern.ROBOT, of_trial, "Falls.\n\nIt matters.")
DIFFERS = "Differs.\n\nIt matters."
TWICE = Rule("TRI916", "differs", Severity.WARNING, Concern.ROBOT, of_both, DIFFERS)
STATIC = rule_saying(finding(at(3), "bent"), id="KIN901")
RULES = (ONCE, TWICE, STATIC)


class Parts:
    """Hands out whatever is asked for, or says why there is no trial."""

    def __init__(self, trial: object) -> None:
        self.trial = trial

    def part(self, kind: str) -> Any:
        if kind == type_name(Wheel):
            return (Wheel(),)
        return self.trial if isinstance(self.trial, NotAvailable) else (self.trial,)


def outcome(part: object = "driven", **settings: Any) -> Outcome:
    return run_rules(RULES, Parts(part), Judge(subt(), Settings(**settings)))


def said(result: Outcome) -> set[str]:
    return {each.rule for each in result.findings}


def test_a_robot_is_driven_once_unless_more_is_asked_for() -> None:
    assert said(outcome()) == {"TRI902", "KIN901"}
    assert not outcome().not_checked
    assert said(outcome(thorough=True)) == {"TRI902", "TRI916", "KIN901"}


def test_no_trial_is_the_users_choice_and_is_said() -> None:
    result = outcome(trial=False, thorough=True)
    assert said(result) == {"KIN901"}
    off = [NotChecked(id, NO_TRIAL, Cause.SWITCHED_OFF) for id in ("TRI902", "TRI916")]
    assert list(result.not_checked) == off
    assert outcome(trial=False, select=("KIN",)).not_checked == ()


def test_what_was_ignored_was_switched_off_whether_driven_or_not() -> None:
    for trial in (True, False):
        (off, *_) = outcome(trial=trial, ignore=("TRI902",)).not_checked
        assert off == NotChecked("TRI902", "switched off", Cause.SWITCHED_OFF)


def test_a_trial_that_cannot_be_had_is_the_reason_not_to_look() -> None:
    result = outcome(NotAvailable("the trial ended in a crash"))
    assert result.not_checked == (
        NotChecked(
            "TRI902", "the trial ended in a crash", Cause.NOT_AT_HAND, Severity.ERROR, Concern.ROBOT
        ),
    )


def test_rules_that_looked_are_named_with_the_options_they_used() -> None:
    result = outcome(options={"TRI902": {"limit": 3}})
    assert result.looked["TRI902"] == {"limit": 3.0}
    assert set(result.looked) == {"TRI902", "KIN901"}
    assert set(outcome(NotAvailable("is broken")).looked) == {"KIN901"}


@pytest.mark.parametrize(
    ("settings", "needed"),
    [
        ({}, {RobotTrial, Wheel}),
        ({"thorough": True}, {RobotTrial, RepeatedTrial, Wheel}),
        ({"trial": False}, {Wheel}),
        ({"select": ("KIN",)}, {Wheel}),
    ],
)
def test_only_parts_that_a_rule_to_be_run_asks_for_are_started(
    settings: dict[str, Any], needed: set[type]
) -> None:
    assert Judge(subt(), Settings(**settings)).needed_parts(RULES) == set(map(type_name, needed))
