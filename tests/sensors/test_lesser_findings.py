"""What a reviewer would not ask about is information, and what stands elsewhere is not missing."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.rule_testing import write_example
from checker.settings import Settings

_SIZE = "<camera><image><width>{}</width><height>480</height></image></camera>"
_BRIDGE = """<node pkg="ros_ign_bridge" type="parameter_bridge" name="lidar"
  {} args="/world/w/model/m/link/mast/sensor/lidar/scan@a/B[c.D"/>
"""
_IMUS = '<sensor name="a" type="imu"/><sensor name="b" type="imu"/>'


def report_of(example: str | Mapping[str, Any], folder: Path, rule: str) -> PackageReport:
    settings = Settings(select=(rule,), trial=False)
    return check_package(write_example(example, folder), settings).packages[0]


def severities(report: PackageReport) -> list[Severity]:
    return [each.severity for each in report.findings]


def cameras(width_of_depth: int) -> str:
    return f"""
<link name="head">
  <sensor name="colour" type="camera">{_SIZE.format(640)}</sensor>
  <sensor name="depth" type="depth_camera">{_SIZE.format(width_of_depth)}</sensor>
</link>
"""


@pytest.mark.parametrize(("width", "severity"), [(640, Severity.WARNING), (424, Severity.INFO)])
def test_cameras_of_two_sizes_may_be_two_devices(tmp_path, width, severity):
    assert severities(report_of(cameras(width), tmp_path, "SEN024")) == [severity]


@pytest.mark.parametrize(("when", "severity"), [("", Severity.ERROR), ('if="0"', Severity.INFO)])
def test_a_bridge_that_is_switched_off_is_no_fault(tmp_path, when, severity):
    launch = f"<launch>{_BRIDGE.format(when)}</launch>"
    report = report_of({"launch/vehicle_topics.launch": launch}, tmp_path, "ROS002")
    assert severities(report) == [severity]


@pytest.mark.parametrize(
    ("kind", "severity"), [("magnetometer", Severity.INFO), ("thermal", Severity.WARNING)]
)
def test_a_magnetometer_need_not_be_listed(tmp_path, kind, severity):
    sheet = "# Rover\n### Sensors\n* IMU: Microstrain GX5\n"
    example = {"@fragment": f'<sensor name="s" type="{kind}"/>', "specifications.md": sheet}
    assert severities(report_of(example, tmp_path, "DOC004")) == [severity]


def test_a_sheet_that_leaves_sensors_to_another_does_not_count_them(tmp_path):
    sheet = "# Rover\n### Sensors\nOthers: [base](../base/specifications.md).\n* 1x IMU\n"
    report = report_of({"@fragment": _IMUS, "specifications.md": sheet}, tmp_path, "DOC003")
    assert not report.findings
    assert [each.reason for each in report.not_checked if each.rule == "DOC003"] == [
        "specifications.md refers to ../base/specifications.md for its sensors"
    ]


def test_a_fault_of_many_meshes_says_how_many(tmp_path):
    shapes = "".join(
        f'<visual><geometry><mesh filename="package://acme_rover_sensor_config_1/{name}.dae"/>'
        "</geometry></visual>"
        for name in ("a", "b", "c", "a")
    )
    urdf = f'<robot name="r"><link name="base_link">{shapes}</link></robot>'
    report = report_of({"urdf/robot_from_sdf.xacro": urdf}, tmp_path, "URD002")
    (found,) = report.findings
    assert found.message.endswith("a.dae does not exist, nor do 2 other meshes")
    assert len(found.places) == 4
