"""Faults that authors of MuJoCo models corrected, and small ones: reported, and gone after."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import VerdictKind
from checker.settings import Settings
from support.real_packages import MJCF, needed_folder, needs
from tests.test_modern_bugs import reported

pytestmark = needs(MJCF)

CORRECTED = {
    "dmc-cmu-shoulder": "MJC012",
    "dmc-manipulator-text": "MJC003",
    "gym-hopper-global": "MJC001",
    "gym-humanoid-hip": "MJC012",
    "gym-swimmer-collision": "MJC001",
    "openarm-material": "MJC001",
}
SMALL = {
    "compiler_overridden": "MJC014",
    "degree_default": "MJC008",
    "double_mass": "MJC013",
    "fullinertia_order": "MJC001",
    "key_shifted": "MJC005",
    "mesh_beside_include": "MJC002",
    "motor_in_radians": "MJC011",
    "not_a_number": "MJC006",
    "reversed_range": "MJC004",
    "static_parent": "MJC009",
    "stray_text": "MJC003",
    "wrong_joint": "MJC010",
}
"""By the name of the fault, the rule that reports it."""
ROBOTS = (
    *("agility_cassie", "anybotics_anymal_c", "bitcraze_crazyflie_2", "franka_fr3"),
    *("kuka_iiwa_14", "trs_so_arm100", "universal_robots_ur5e", "wonik_allegro"),
)


@pytest.mark.parametrize("name", CORRECTED)
def test_a_fault_is_reported_until_it_is_corrected(name: str) -> None:
    case = needed_folder(MJCF) / "bugs" / name
    told = json.loads((case / "case.json").read_text("utf-8"))
    changed = {Path(file).name for file in told["file"]}
    folder = Path(told["check"]).parent
    before = reported(case / "before" / folder, CORRECTED[name])
    after = reported(case / "after" / folder, CORRECTED[name])
    assert {Path(file).name for file, _ in before - after} & changed


@pytest.mark.parametrize("name", SMALL)
def test_a_small_fault_is_reported(name: str) -> None:
    repro = needed_folder(MJCF) / "repro"
    assert reported(repro / name, SMALL[name])
    assert not reported(repro / "clean", SMALL[name])


def test_placeholder_moments_of_fingers_are_reported() -> None:
    found = reported(needed_folder(MJCF) / "agilex_piper", "MJC015")
    assert sum("link7" in message or "link8" in message for _, message in found) == 2


@pytest.mark.parametrize("name", ROBOTS)
def test_nothing_is_reported_of_a_robot_that_is_right(name: str) -> None:
    (package,) = check_package(needed_folder(MJCF) / name, Settings()).packages
    assert package.verdict is VerdictKind.READY
    assert not package.findings
