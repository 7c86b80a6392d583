"""A macro that is not available may add what the robot seems to lack."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control
from checker.settings import Settings

UNREAD = """<xacro:include filename="$(find acme_drives)/urdf/drive.xacro"/>
<xacro:drive/>
"""
ARM = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
<link name="base_link"/>
<link name="upper_arm"/>
<joint name="shoulder" type="revolute">
  <parent link="base_link"/><child link="upper_arm"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
{}
</robot>
"""


@pytest.mark.parametrize("own", [gazebo_control(""), ros2_control(hardware=GAZEBO)])
@pytest.mark.parametrize("unread", [UNREAD, ""])
def test_a_tag_or_plugin_may_be_in_a_macro(own: str, unread: str, tmp_path: Path) -> None:
    example = {
        "@urdf": True,
        "urdf/arm.urdf": None,
        "urdf/arm.urdf.xacro": ARM.format(unread + own),
    }
    settings = Settings(profile="ros2", profile_chosen=True, select=("R2C005",), trial=False)
    (report,) = check_package(write_example(example, tmp_path), settings).packages
    reasons = [it.reason for it in report.not_checked if it.rule == "R2C005"]
    assert bool(report.findings) is not bool(unread)
    assert any("macro drive of acme_drives" in reason for reason in reasons) is bool(unread)
