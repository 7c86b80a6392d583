"""Faults that authors of ROS 2 and Gazebo packages corrected: reported before, and gone after."""

from __future__ import annotations

import json
from collections import Counter
from itertools import chain
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings
from support.real_packages import MODERN, needed_folder, needs

pytestmark = needs(MODERN)

RULES = {
    "ardupilot-tether": "INE004",
    "create3-stability": "INE009",
    "demos-limits": "KIN007",
    "demos-steer-velocity": "KIN007",
    "gzrc-find-pkg": "R2C006",
    "gzrc-gripper-inertia": "INE007",
    "gzrc-plugin-names": "R2C006",
    "gzrc-robot-name": "URD020",
    "gzrc-steer-inertial": "URD007",
    "mycobot-flange": "URD031",
    "nav2-dae-path": "REF002",
    "nav2-home-path": "WIR014",
    "nav2-imu-joint": "KIN003",
    "panda-inertials": "URD007",
    "panda-mimic": "R2C002",
    "px4-frame-id": "SEN028",
    "tb3-link-typo": "KIN001",
    "tb3sim-imu-joint": "KIN003",
}
"""By the name of the fault, the rule that reports it."""
NOT_READ = {
    "MoveIt's configuration": (
        "chomp-clearance-key",
        "dual-arm-limits",
        "fanuc-cartesian-int",
        "fanuc-sensors-form",
        "panda-duration-key",
        "panda-finger-acc",
        "panda-folded-comment",
        "panda-planning-jazzy",
        "so100-controllers",
        "xarm-acc",
    ),
    "SRDF with arguments of xacro": ("xarm-srdf-name", "xarm6-adjacent"),
    "parameters of Nav2": (
        "lino-base-scan",
        "lino-voxel",
        "nav2-goal-checker-type",
        "nav2-wait-type",
        "sam-footprint",
        "sam-odom-topic",
        "sam-simtime",
        "tb3-recoveries",
        "yahboom-checker",
    ),
    "parameters of localization": ("lino-amcl-model", "tb3-amcl-model", "yahboom-ekf-topic"),
}
"""By the kind of file that no rule reads yet, the faults in such files."""
OUT_OF_REACH = {
    "nav2-caster-radius": "casters that hang by one millimetre are within every tolerance",
    "panda-soft-limit": "the soft limit lies within the limit that the file states",
}


def reported(path: Path, rule: str) -> Counter[tuple[str, str]]:
    """Return files and messages of all that a rule reports, as a user without options sees it."""
    report = check_package(path, Settings(trial=False, select=(rule,)))
    return Counter(
        (place.file, place.message or finding.message)
        for package in report.packages
        for finding in package.findings
        for place in finding.places
        if not place.note
    )


def test_all_faults_are_listed() -> None:
    cases = {case.name for case in (needed_folder(MODERN) / "bugs").iterdir()}
    listed = {*RULES, *OUT_OF_REACH, *chain.from_iterable(NOT_READ.values())}
    assert listed <= cases
    if cases > listed:
        pytest.skip(f"new and not listed yet: {', '.join(sorted(cases - listed))}")


@pytest.mark.parametrize("name", RULES)
def test_the_fault_is_reported_until_it_is_corrected(name: str) -> None:
    case = needed_folder(MODERN) / "bugs" / name
    told = json.loads((case / "case.json").read_text("utf-8"))
    changed = {Path(file).name for file in told["file"]}
    before = reported(case / "before" / told["check"], RULES[name])
    after = reported(case / "after" / told["check"], RULES[name])
    assert {Path(file).name for file, _ in before - after} & changed
