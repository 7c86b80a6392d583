"""A xacro that serves several simulators is not judged by the plugins of one."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings

BOTH = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="classic" default="{default}"/>
<link name="base_link"/>
<xacro:if value="$(arg classic)">
  <gazebo><plugin filename="libgazebo_ros_p3d.so" name="pose"/></gazebo>
</xacro:if>
<xacro:unless value="$(arg classic)">
  <gazebo><plugin filename="{other}" name=""/></gazebo>
</xacro:unless>
</robot>
"""
LATER = "gz-sim-pose-publisher-system"


def judged(folder: Path, **words: str) -> PackageReport:
    (folder / "r.urdf.xacro").write_text(BOTH.format(**words))
    (folder / "package.xml").write_text("<package><name>r</name></package>")
    settings = Settings(profile="ros2", profile_chosen=True, trial=False, select=("PLG001",))
    (report,) = check_package(folder, settings).packages
    return report


def test_nothing_is_said_where_the_default_is_classic(tmp_path: Path) -> None:
    report = judged(tmp_path, default="true", other=LATER)
    assert not report.findings
    assert ["by default Gazebo Classic" in each.reason for each in report.not_checked] == [True]


@pytest.mark.parametrize(
    ("default", "other", "count"),
    [("false", LATER, 0), ("true", "libgazebo_ros_imu.so", 1)],
)
def test_others_are_judged(tmp_path: Path, default: str, other: str, count: int) -> None:
    report = judged(tmp_path, default=default, other=other)
    assert len(report.findings) == count
    assert not report.not_checked
