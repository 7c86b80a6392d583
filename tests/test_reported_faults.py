"""Faults that people reported in public, rebuilt small: told on `bad`, and nothing on `good`."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import ReportedFinding, Severity
from checker.settings import Settings
from support.real_packages import REPORTS, judged_folders, needed_folder, needs

pytestmark = needs(REPORTS)

RULES = {
    "06-two-odom-tf": "WIR001",
    "06b-two-odom-tf-gz": "WIR001",
    "10-spawn-topic": "WIR002",
    "10b-spawn-topic-gz": "WIR002",
    "11-sensor-hinge": "KIN009",
    "13-mimic-dart": "KIN018",
    "16-node-key": "WIR003",
    "17-model-path": "LCH012",
    "18-install-dir": "PKG009",
}
"""By the name of the fault, the rule that names its cause."""
CLASSIC = ("06-two-odom-tf", "10-spawn-topic", "17-model-path")
"""Reported of Gazebo Classic, with ROS 2 Humble."""


def told(folder: Path, name: str) -> list[ReportedFinding]:
    """Return the errors and warnings of the packages in a folder."""
    settings = Settings(distro="humble" if name in CLASSIC else "", trial=False)
    report = check_package(folder, settings)
    found = (finding for package in report.packages for finding in package.findings)
    return [finding for finding in found if finding.severity is not Severity.INFO]


def test_every_report_has_its_rule() -> None:
    needed_folder(REPORTS)
    assert {folder.name for folder in judged_folders(REPORTS)} == RULES.keys()


@pytest.mark.parametrize(("name", "rule"), RULES.items())
def test_the_cause_is_told_and_nothing_once_it_is_mended(name: str, rule: str) -> None:
    folder = needed_folder(REPORTS) / name
    assert {finding.rule for finding in told(folder / "bad", name)} == {rule}
    assert told(folder / "good", name) == []
