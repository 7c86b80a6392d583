"""A model that is not available may have topics; what is read of the robot is judged."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings

UNREAD = "<include><uri>model://acme_mast</uri></include>"
ROVER = """<sdf version="1.9"><model name="rover"><link name="base_link">
<sensor name="lidar" type="gpu_lidar"><topic>scan</topic></sensor>
</link>@</model></sdf>
"""
ENTRIES = """- topic_name: /lidar
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
  direction: GZ_TO_ROS
- topic_name: /weight
  ros_type_name: geometry_msgs/msg/Wrench
  gz_type_name: gz.msgs.Wrench
  direction: GZ_TO_ROS
"""


@pytest.mark.parametrize(
    ("unread", "reported"), [(UNREAD, ["/lidar"]), ("", ["/lidar", "/weight"])]
)
def test_a_topic_is_certain_beside_one_that_is_read(
    unread: str, reported: list[str], tmp_path: Path
) -> None:
    example = {
        "@bridge": ENTRIES,
        "@launch": {'"rover.urdf"': '"rover.sdf"'},
        "urdf/rover.sdf": ROVER.replace("@", unread),
        "urdf/rover.urdf": None,
    }
    settings = Settings(profile="ros2", profile_chosen=True, select=("BRG004",), trial=False)
    report = check_package(write_example(example, tmp_path), settings).packages[0]
    messages = [it.message for it in report.findings]
    assert [topic for topic in ("/lidar", "/weight") if topic in str(messages)] == reported
    reasons = [it.reason for it in report.not_checked if it.rule == "BRG004"]
    assert any("model://acme_mast" in reason for reason in reasons) is bool(unread)
