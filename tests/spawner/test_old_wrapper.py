"""What an older spawner wraps in the launcher's plugin is judged as what `<spawn>` holds."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings
from tests.conftest import SAMPLES

BUGGY = "subtcheck_buggy_sensor_config_1"
ROVER = "broken_rover_sensor_config_1"
SPAWNER = "launch/spawner.rb"
WRAPPED = "SPW007"

BREADCRUMBS = """<plugin filename="libBreadcrumbsPlugin.so" name="subt::Breadcrumbs">
<max_deployments>5</max_deployments></plugin>"""
SLIP = """<plugin filename="libignition-gazebo-wheel-slip-system.so"
name="ignition::gazebo::systems::WheelSlip"><wheel link_name="no_wheel">
<wheel_radius>9</wheel_radius></wheel></plugin>"""
FAULTS = {
    "nothing": ("#", "#"),
    "pose": (r"#\{_roll\} #\{_pitch\}", "0 0"),
    "no pose": ("<pose>.*</pose>", ""),
    "height": (r"_z \+ 0.15", "_z"),
    "name": (r"<name>#\{_name\}", "<name>robot"),
    "model": ("#{_modelURI}", "model://robot"),
    "world": ("<world>.*</world>", ""),
    "performer": ("<is_performer>.*", ""),
    "limits": ("<max_velocity>1", "<max_velocity>7"),
    "wheel radius": ("<wheel_radius>0.1<", "<wheel_radius>0.3<"),
    "joint": ("front_left_wheel_joint", "front_lft_wheel_joint"),
    "no gas detector": ('(?s)<plugin filename="libGas.*?</plugin>', ""),
    "no poses": (r'(?s)<plugin filename="libignition-gazebo-pose.*?</plugin>', ""),
    "true pose": (r"#\{\$enableGroundTruth\}", "true"),
    "no battery": (r'(?s)<plugin filename="libignition-gazebo-linear.*?</plugin>', ""),
    "battery": ("<voltage>.*", ""),
    "topic": ("/gas_detected", "/gas"),
    "breadcrumbs": ("</include>", f"{BREADCRUMBS}</include>"),
    "wheel slip": ("</include>", f"{SLIP}</include>"),
    "no drive": ('(?s)<plugin filename="libignition-gazebo-ackermann.*?</plugin>', ""),
    "unknown plugin": ("libGasEmitterDetectorPlugin.so", "libGasPlugin.so"),
    "no sdf": ("</?sdf.*>", ""),
}


def wrapped(spawner: str) -> str:
    """Return a spawner as it was written before there was `<spawn>`."""
    opening = (
        r"<plugin name=\1ignition::launch::GazeboFactory\1"
        r" filename=\1libignition-launch-gazebo-factory.so\1>"
    )
    spawner, count = re.subn(r"<spawn name=(\\?[\"'])#\{_name\}\1>", opening, spawner)
    assert count == 1
    return spawner.replace("</spawn>", "</plugin>")


def said(report: PackageReport) -> set[tuple[object, ...]]:
    """Return what the rules report, and what they did not check."""
    found = {
        (each.rule, each.severity, each.message, *((p.file, p.line) for p in each.places))
        for each in report.findings
    }
    return found | {(each.rule, each.reason) for each in report.not_checked}


def report_of(package: Path) -> PackageReport:
    settings = Settings(profile="subt", profile_chosen=True, trial=False)
    (report,) = check_package(package, settings).packages
    return report


def differences(package: Path) -> tuple[set[tuple[object, ...]], set[tuple[object, ...]]]:
    """Return what is said of a package alone, and of it with the wrapper alone."""
    today = said(report_of(package))
    spawner = package / SPAWNER
    spawner.write_text(wrapped(spawner.read_text("utf-8")), "utf-8")
    before = said(report_of(package))
    return today - before, before - today


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_the_wrapper_is_found_as_in_spawn(fault: str, tmp_path: Path) -> None:
    package = shutil.copytree(SAMPLES / BUGGY, tmp_path / BUGGY)
    spawner = package / SPAWNER
    text, count = re.subn(*FAULTS[fault], spawner.read_text("utf-8"))
    assert count
    spawner.write_text(text, "utf-8")
    lost, [more] = differences(package)
    assert not lost
    assert more[0] == WRAPPED


def test_nothing_else_differs_in_a_robot_of_many_faults(tmp_path: Path) -> None:
    lost, [more] = differences(shutil.copytree(SAMPLES / ROVER, tmp_path / ROVER))
    assert not lost
    assert more[0] == WRAPPED


def test_nothing_else_differs_in_real_robots(corpus, tmp_path: Path) -> None:
    packages = shutil.copytree(corpus.root, tmp_path / "packages", symlinks=True)
    compared = 0
    for spawner in sorted(packages.glob(f"*/{SPAWNER}")):
        if "</spawn>" in spawner.read_text("utf-8"):
            compared += 1
            lost, [more] = differences(spawner.parent.parent)
            assert not lost
            assert more[0] == WRAPPED
    assert compared > 10


def test_the_spawns_in_a_wrapper_are_what_it_spawns(tmp_path: Path) -> None:
    package = shutil.copytree(SAMPLES / BUGGY, tmp_path / BUGGY)
    spawner = package / SPAWNER
    text = spawner.read_text("utf-8")
    text = text.replace("<spawn ", '<plugin name="ignition::launch::GazeboFactory"><spawn ', 1)
    spawner.write_text(text.replace("</spawn>", "</spawn></plugin>"), "utf-8")
    assert [each.rule for each in report_of(package).findings] == [WRAPPED]
