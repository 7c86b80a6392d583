"""The first screen: what to do first, and the trial in words."""

from __future__ import annotations

from checker.pipeline import check_package
from checker.report.html.findings import anchor_of
from checker.report.html.overview import first_tasks, trial_sentences
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.report.test_trial_text import figure, trial

DRIVE = {"name": "drive", "start": 0.0, "end": 4.0, "linear": 0.5, "angular": 0.0}
TURN = {"name": "turn", "start": 4.0, "end": 8.0, "linear": 0.0, "angular": 0.5}


def test_a_good_drive_is_told_in_words() -> None:
    driven = trial(
        figure("speed_ratio", 0.98),
        figure("stop_distance", 0.126, "m", verdict="not judged"),
        figure("yaw_rate", 0.306, "rad/s"),
        figure("full_speed", 1.0, "m/s"),
        course=[DRIVE, TURN],
    )
    assert trial_sentences(driven) == [
        "In MuJoCo the robot drives at 0.49 m/s (0.5 commanded), stops within 0.126 m, turns at "
        "0.306 rad/s (0.5 commanded) and reaches 1 m/s at full speed.",
        "All 3 figures that rules judge are within their limits.",
    ]


def test_what_is_out_of_its_limits_is_named_with_them() -> None:
    tilt = figure("settle_tilt", 0.35, "rad", verdict="error", limits={"above": 0.26})
    assert trial_sentences(trial(figure("climbed", 1.02), tilt), "ds1") == [
        "In MuJoCo ds1 climbs 1.02 m (1 commanded).",
        "Outside their limits, 1 of 2 figures: settle tilt 20.1° (ok up to 14.9°).",
    ]


def test_what_nobody_could_judge_is_not_told_as_a_drive() -> None:
    unjudged = figure("speed_ratio", 0.0, verdict="not judged", rule="TRI003")
    driven = trial(unjudged, figure("settle_drop", 0.01), course=[DRIVE])
    why = "an end of joint 'j' is not known"
    assert trial_sentences(driven, unseen=why) == [
        "1 figure is not judged: an end of joint 'j' is not known.",
        "The one figure that a rule judges is within its limits.",
    ]


def test_a_refused_model_has_no_figures() -> None:
    assert trial_sentences(trial(refused="mass is 0")) == ["MuJoCo refuses the model: mass is 0."]


def test_what_keeps_the_model_from_loading_is_to_be_done_first() -> None:
    found = check_package(SAMPLES / "broken_rover_sensor_config_1", Settings(trial=False))
    rules = {anchor_of(each): each.rule for each in found.packages[0].findings}
    tasks = first_tasks(found.packages[0])
    assert [rules[task.anchor][:3] for task in tasks] == ["SDF", "SDF", "SDF"]
