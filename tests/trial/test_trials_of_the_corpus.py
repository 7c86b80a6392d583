"""Every accepted robot drives as it should: what fails here is a fault of ours."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.mjcf.layout import Layout
from checker.physics.trial.trial import Trial, too_weak
from tests.trial.machines import trial_in_child, value


@pytest.fixture(scope="module")
def trials(corpus: Path) -> dict[str, Trial]:
    found = {}
    with open_input(corpus) as opened:
        for package in opened.packages:
            robots = Subject(package).all(Robot)
            if isinstance(robots, tuple):
                trial = trial_in_child(robots[0])
                assert isinstance(trial, Trial), f"{package.name}: {trial}"
                found[package.name] = trial
    return found


def of_kind(trials: dict[str, Trial], *words: str) -> dict[str, Trial]:
    return {n: trial for n, trial in trials.items() if any(word in trial.drive for word in words)}


def test_mujoco_takes_every_robot_and_settles_it(trials: dict[str, Trial]) -> None:
    assert trials
    for name, trial in trials.items():
        assert not trial.refused, name
        assert not trial.trouble, name
        assert value(trial, "settle_speed") < 0.01, name
        assert value(trial, "settle_tilt") < 0.05, name
        assert value(trial, "settle_drop") < 0.03, name
        assert value(trial, "energy_gain") < 0.1, name


def test_wheels_and_tracks_drive_straight_at_the_commanded_speed(trials: dict[str, Trial]) -> None:
    for name, trial in of_kind(trials, "drive", "Ackermann", "tracks").items():
        assert 0.97 < value(trial, "speed_ratio") < 1.03, name
        assert abs(value(trial, "path_sideways")) < 0.02, name
        assert value(trial, "stop_speed") < 0.01, name


def test_turns_are_what_the_contact_loads_predict(trials: dict[str, Trial]) -> None:
    for name, trial in of_kind(trials, "drive", "Ackermann", "tracks").items():
        # Flippers that are too weak give way, and wheels that are too weak turn slower.
        least = 0.65 if too_weak(trial.measurements) else 0.8
        assert least < value(trial, "yaw_of_predicted") < 1.2, name
        assert (trial.value("turn_drift") or 0.0) < 0.5, name


def test_copters_hover_and_climb(trials: dict[str, Trial]) -> None:
    for name, trial in of_kind(trials, "multicopter").items():
        assert value(trial, "hover_effort") < 1.0, name
        assert abs(value(trial, "hover_sink")) < 0.02, name
        assert value(trial, "climbed") == pytest.approx(1.0, abs=0.05), name


def test_legs_stand(trials: dict[str, Trial]) -> None:
    for name, trial in of_kind(trials, "legs").items():
        (sag,) = trial.all("hold_sag")
        assert sag.value < 0.01, name
        assert abs(value(trial, "hold_sink")) < 0.01, name
        assert value(trial, "hold_tilt") < 0.02, name


def test_masses_are_those_of_the_file_or_a_repair_names_the_link(corpus: Path) -> None:
    with open_input(corpus) as opened:
        for package in opened.packages:
            robots = Subject(package).all(Robot)
            for robot in robots if isinstance(robots, tuple) else ():
                layout = Layout(robot)
                taken = {name: body.mass for name, body in layout.inertias.items()}
                repaired = {repair.part for repair in layout.ledger.repairs}
                for link in robot.links:
                    kept = taken[link.scoped_name] == pytest.approx(link.mass, rel=1e-3)
                    assert kept or link.scoped_name in repaired, (package.name, link.name.value)
