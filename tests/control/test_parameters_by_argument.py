"""Files of parameters that a launch file gives as an argument of xacro."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings
from rules.ros2_control.r2c006_parameter_file_not_found import given


@pytest.mark.parametrize(
    ("argument", "is_reported"), [("control_file:=$(env ARM_FILE)", False), ("", True)]
)
def test_a_file_that_a_launch_file_gives_is_not_checked(
    argument: str, is_reported: bool, tmp_path: Path
) -> None:
    package = write_example(given(argument), tmp_path)
    (report,) = check_package(package, Settings(trial=False, select=("R2C006",))).packages
    reasons = [it.reason for it in report.not_checked if it.rule == "R2C006"]
    assert bool(report.findings) is is_reported
    assert any("$(arg control_file)" in reason for reason in reasons) is not is_reported


def test_without_launch_files_nothing_says_what_is_given(tmp_path: Path) -> None:
    package = write_example(given(""), tmp_path)
    shutil.rmtree(package / "launch")
    (report,) = check_package(package, Settings(trial=False, select=("R2C006",))).packages
    assert not report.findings
