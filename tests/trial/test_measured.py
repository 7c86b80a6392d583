"""A trial in the report: each figure with its limits, and what the rules said about it."""

from __future__ import annotations

import json
import math
from typing import Any

import jsonschema
import pytest

from checker.engine.facts import trial_facts
from checker.engine.judge import TRIALS, Judge
from checker.engine.run import Outcome, run_rules
from checker.physics.trial.robot_trial import RobotTrial
from checker.physics.trial.trial import Measurement, Trial
from checker.rulebook.discovery import all_rules
from checker.rulebook.profiles import profile
from checker.settings import Settings
from tests.test_samples import SCHEMA
from tests.trial.driven import rover, trial_of

OF_TRIAL = [rule for rule in all_rules() if rule.group == "TRI"]


class Parts:
    """Hands out a trial and nothing else."""

    def __init__(self, trial: Trial) -> None:
        self.driven = RobotTrial(rover(), trial)

    def part(self, kind: str) -> Any:
        assert kind in TRIALS
        return (self.driven,)


def shown(trial: Trial, **settings: Any) -> dict[str, Any]:
    parts = Parts(trial)
    outcome = run_rules(OF_TRIAL, parts, Judge(profile("subt"), Settings(**settings)))
    said = json.loads(json.dumps(trial_facts(parts.driven, outcome, all_rules())))
    jsonschema.validate(said, {**SCHEMA["$defs"]["TrialJson"], "$defs": SCHEMA["$defs"]})
    return dict(said)


def figures(trial: Trial, **settings: Any) -> dict[tuple[str, str], dict[str, Any]]:
    return {(e["name"], e["part"]): e for e in shown(trial, **settings)["measurements"]}


def test_a_figure_has_its_meaning_its_limits_and_a_verdict() -> None:
    (speed,) = figures(trial_of(speed_ratio=0.900000001)).values()
    assert speed == {
        "name": "speed_ratio",
        "label": "speed reached / commanded",
        "value": 0.9,
        "unit": "",
        "part": "",
        "other": "",
        "rule": "TRI003",
        "limits": {"warning_beyond": 0.05, "error_beyond": 0.15},
        "verdict": "warning",
    }


def test_limits_are_those_that_were_used_and_those_of_the_figure() -> None:
    trial = trial_of(settle_tilt=0.1, speed_ratio=0.9)
    options = {"TRI003": {"warning_beyond": 0.2}, "TRI002": {"settle_tilt_above": 0.05}}
    tilt, speed = figures(trial, options=options).values()
    assert (tilt["limits"], tilt["verdict"]) == ({"above": 0.05}, "error")
    assert (speed["limits"]["warning_beyond"], speed["verdict"]) == (0.2, "ok")


def test_each_part_has_its_own_verdict() -> None:
    loads = (Measurement("load_share", v, p) for v, p in ((0.0, "left_front"), (1.3, "left_rear")))
    said = figures(trial_of(*loads))
    assert said["load_share", "left_front"]["verdict"] == "error"
    assert said["load_share", "left_rear"]["verdict"] == "ok"


def test_one_finding_about_two_figures_counts_for_both_and_no_more() -> None:
    said = figures(trial_of(settle_drop=0.5, settle_tilt=1.0, settle_shift=0.0))
    assert [each["verdict"] for each in said.values()] == ["error", "error", "ok"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "good", "bad"),
    [
        ("hover_effort", 0.9, 1.1),
        ("hover_sink", 0.1, 0.3),
        ("hover_tilt", 0.2, 0.3),
        ("climbed", 0.9, 0.7),
    ],
)
def test_each_figure_of_a_hover_has_its_limit(name: str, good: float, bad: float) -> None:
    for value, verdict in ((good, "ok"), (bad, "error")):
        (figure,) = figures(trial_of(**{name: value})).values()
        assert figure["verdict"] == verdict


def test_what_no_rule_looked_at_is_not_judged() -> None:
    trial = trial_of(stop_distance=0.1, speed_ratio=0.1, thrust_to_weight=1e4)
    said = figures(trial, ignore=("TRI003",))
    assert {each["verdict"] for each in said.values()} == {"not judged"}


@pytest.mark.parametrize(("option", "verdict"), [(1.0, "not judged"), (2.0, "ok")])
def test_a_torque_beyond_its_limit_is_not_ok_because_the_rule_is_silent(
    option: float, verdict: str
) -> None:
    """As TRI009 is where specifications.md explains the limit."""
    figures = (
        Measurement("torque", 36.6, "left_front"),
        Measurement("torque_limit", 20.0, "left_front"),
    )
    silent = Outcome((), (), {"TRI009": {"warning_above": option}})
    said = trial_facts(RobotTrial(rover(), trial_of(*figures)), silent, all_rules())["measurements"]
    assert said[0]["verdict"] == verdict


def test_what_is_no_figure_is_left_out() -> None:
    said = shown(trial_of(speed_ratio=math.inf, series={"x": (1.0, math.nan)}))
    assert said["measurements"] == []
    assert said["series"] == {"x": [1.0, None]}
