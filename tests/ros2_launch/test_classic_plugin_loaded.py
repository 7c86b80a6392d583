"""A Classic plugin in a URDF is an error where a launch file spawns it into Gazebo."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings

URDF = """<robot name="{}">
  <link name="base_link"/>
  <gazebo><plugin filename="libgazebo_ros_imu_sensor.so" name="imu"/></gazebo>
</robot>
"""
PLAIN = '<robot name="rover"><link name="base_link"/></robot>\n'


@pytest.mark.parametrize(
    ("files", "severity"),
    [
        ({"urdf/rover.urdf": URDF.format("rover")}, Severity.ERROR),
        ({"urdf/rover.urdf": PLAIN, "urdf/old.urdf": URDF.format("old")}, Severity.WARNING),
    ],
)
def test_severity(tmp_path: Path, files: dict[str, str], severity: Severity) -> None:
    folder = write_example({"@bridge": True, **files}, tmp_path)
    settings = Settings(
        trial=False, select=("PLG001",), profile="ros2", profile_chosen=True, distro="jazzy"
    )
    (report,) = check_package(folder, settings).packages
    assert [finding.severity for finding in report.findings] == [severity]
