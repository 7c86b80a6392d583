"""A model file that the README calls an unused copy: what is found in it is information."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.physics.fault import Fault, Swap, put_into

SAMPLE = "subtcheck_buggy_sensor_config_1"
FAULT = Fault("", (Swap("<mass>15.4</mass>", "<mass>-15.4</mass>"),), (), "")


def severities(package: Path) -> list[str]:
    (report,) = check_package(package, Settings(select=("INE002",))).packages
    return [str(finding.severity) for finding in report.findings]


@pytest.mark.parametrize(
    ("readme", "severity"),
    [
        ("The spawner takes the model from Fuel. The model.sdf here is an unused copy.", "info"),
        ("`model.sdf` is not used:\nit is only a copy of the one on Fuel.", "info"),
        ("The simulator never reads model.sdf! It reads the one on Fuel.", "info"),
        ("The camera is not used. model.sdf holds the robot.", "error"),
        ("", "error"),
    ],
)
def test_what_is_found_in_it_is_a_note(readme: str, severity: str, tmp_path: Path) -> None:
    assert (SAMPLES / SAMPLE / "model.sdf").is_file()
    package = put_into(SAMPLE, FAULT, tmp_path)
    (package / "README.md").write_text(readme, "utf-8")
    assert severities(package) == [severity]
