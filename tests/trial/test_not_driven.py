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
from checker.rule_testing import write_example
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


CART = """<link name="cart_wheel"><collision><geometry><sphere radius="0.1"/></geometry>
</collision></link><joint name="cart_wheel" type="continuous"><parent link="base_link"/>
<child link="cart_wheel"/><axis xyz="0 1 0"/></joint>"""
MODEL = """<sdf version="1.9"><model name="{}"><plugin filename="p" name="gz::sim::systems::{}">
<left_joint>{}</left_joint><joint_name>cart_wheel</joint_name></plugin></model></sdf>"""


@pytest.mark.parametrize(
    ("name", "plugin", "joint", "named"),
    [
        ("arm", "DiffDrive", "cart_wheel", True),
        ("arm", "JointStatePublisher", "cart_wheel", False),
        ("arm", "DiffDrive", "other_wheel", False),
        ("other", "DiffDrive", "cart_wheel", False),
    ],
)
def test_the_reason_names_the_sdf_file_with_the_drive(
    tmp_path: Path, name: str, plugin: str, joint: str, named: bool
) -> None:
    files = {"@urdf": CART, "models/cart/cart.sdf": MODEL.format(name, plugin, joint)}
    with open_input(write_example(files, tmp_path)) as opened:
        (robot,) = Subject(opened.packages[0]).all(Robot)
    assert ("its drive is in models/cart/cart.sdf" in plan_of(robot).not_driven) is named


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


def test_a_robot_whose_collision_mesh_is_missing(tmp_path: Path) -> None:
    package = changed("subtcheck_buggy", tmp_path)
    model = package / "model.sdf"
    text = model.read_text("utf-8")
    before, opening, after = text.partition("<collision")
    _, closing, rest = after.partition("</geometry>")
    mesh = "<geometry><mesh><uri>meshes/gone.stl</uri></mesh>"
    model.write_text(f'{before}{opening} name="c">{mesh}{closing}{rest}', "utf-8")
    report = driven(package)
    assert not report.findings
    assert "meshes/gone.stl does not exist" in report.blind_spots[0].reason
