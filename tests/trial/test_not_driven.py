"""A robot that has a drive and is not driven is never ready."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.drivers.plans import plan_of
from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings
from tests.conftest import SAMPLES

SPAWNER = "launch/spawner.rb"


def changed(sample: str, folder: Path, *changes: tuple[str, str]) -> Path:
    package = folder / f"{sample}_sensor_config_1"
    shutil.copytree(SAMPLES / package.name, package)
    spawner = (package / SPAWNER).read_text("utf-8")
    for old, new in changes:
        assert old in spawner
        spawner = spawner.replace(old, new)
    (package / SPAWNER).write_text(spawner, "utf-8")
    return package


def driven(package: Path) -> PackageReport:
    (report,) = check_package(package, Settings(select=("TRI",))).packages
    assert not report.crashed, report.not_checked
    return report


def test_tracks_that_no_controller_moves(tmp_path: Path) -> None:
    package = changed("subtcheck_crawler", tmp_path, ("systems::TrackController", "systems::Other"))
    report = driven(package)
    assert report.verdict is VerdictKind.INCOMPLETE
    assert "drive no part of the model" in report.blind_spots[0].reason


@pytest.mark.parametrize("new", ["nothing_joint", "left_other_joint"])
def test_a_car_without_steering_joints(tmp_path: Path, new: str) -> None:
    changes = [(f">{side}_steering_joint<", f">{side}_{new}<") for side in ("left", "right")]
    report = driven(changed("subtcheck_buggy", tmp_path, *changes))
    assert report.verdict is VerdictKind.INCOMPLETE
    assert "steer no part of the model" in report.blind_spots[0].reason


@pytest.mark.parametrize("tag", ["max_velocity", "max_acceleration"])
def test_a_limit_of_zero_keeps_it_from_moving(tmp_path: Path, tag: str) -> None:
    package = changed("husky_migration", tmp_path)
    spawner = (package / SPAWNER).read_text("utf-8")
    start, end = spawner.index(f"<{tag}>"), spawner.index(f"</{tag}>")
    (package / SPAWNER).write_text(f"{spawner[:start]}<{tag}>0{spawner[end:]}", "utf-8")
    report = driven(package)
    assert [each.rule for each in report.findings if each.severity == "error"] == ["TRI003"]


def test_constants_that_a_motor_does_not_state_are_the_plugin_s(tmp_path: Path) -> None:
    package = changed("subtcheck_quadro", tmp_path, ("maxRotVelocity", "maxRotSpeed"))
    with open_input(package) as opened:
        (robot,) = Subject(opened.packages[0]).all(Robot)
    plan = plan_of(robot)
    assert len(plan.rotors) == 4
    assert not plan.notes
