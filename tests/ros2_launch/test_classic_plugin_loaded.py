"""A Classic plugin in a URDF is an error where a launch file spawns it, else information."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import ReportedFinding
from checker.rule_testing import write_example
from checker.settings import Settings

URDF = """<robot name="{}">
  <link name="base_link"/>
  <gazebo><plugin filename="libgazebo_ros_imu_sensor.so" name="imu"/></gazebo>
</robot>
"""
DEPTH = """<robot name="rover">
  <link name="base_link"/>
  <gazebo reference="base_link"><sensor name="eye" type="depth">
    <plugin filename="libgazebo_ros_camera.so" name="eye"/>
  </sensor></gazebo>
</robot>
"""
PLAIN = '<robot name="rover"><link name="base_link"/></robot>\n'


@pytest.mark.parametrize(
    ("files", "severity"),
    [
        ({"urdf/rover.urdf": URDF.format("rover")}, Severity.ERROR),
        ({"urdf/rover.urdf": PLAIN, "urdf/old.urdf": URDF.format("old")}, Severity.INFO),
    ],
)
def test_severity(tmp_path: Path, files: dict[str, str], severity: Severity) -> None:
    assert [finding.severity for finding in found(files, tmp_path)] == [severity]


def test_camera_of_depths(tmp_path: Path) -> None:
    (finding,) = found({"urdf/rover.urdf": DEPTH}, tmp_path)
    assert "rgbd_camera" in finding.message


def found(files: dict[str, str], folder: Path) -> tuple[ReportedFinding, ...]:
    package = write_example({"@bridge": True, **files}, folder)
    settings = Settings(
        trial=False, select=("PLG001",), profile="ros2", profile_chosen=True, distro="jazzy"
    )
    (report,) = check_package(package, settings).packages
    return report.findings
