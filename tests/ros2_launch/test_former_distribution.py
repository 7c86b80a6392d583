"""What is for a distribution before Humble, or for a fork, is not compared with what Humble has."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control
from checker.settings import Settings

PARAMETERS = "<parameters>$(find acme_arm_description)/config/arm.yaml</parameters>"
ARM = {
    "@urdf": ros2_control(hardware=GAZEBO) + gazebo_control(PARAMETERS),
    "config/arm.yaml": """controller_manager:
  ros__parameters:
    arm_controller:
      type: effort_controllers/JointGroupPositionController
""",
}
LAUNCH = {
    "@ros2": "        Node(package='controller_manager', executable='spawner.py'),",
}


def repositories(owner: str) -> dict[str, str]:
    url = f"https://example.org/{owner}/ros2_controllers.git"
    return {"arm.repos": f"repositories:\n  controllers:\n    type: git\n    url: {url}\n"}


@pytest.mark.parametrize(
    ("rule", "files", "found"),
    [
        ("R2C008", ARM, True),
        ("R2C008", {**ARM, "README.md": "For ROS 2 Foxy\n"}, False),
        ("R2C008", {**ARM, **repositories("ros-controls")}, True),
        ("R2C008", {**ARM, **repositories("acme")}, False),
        ("LCH015", LAUNCH, True),
        ("LCH015", {**LAUNCH, "README.md": "For ROS 2 Foxy\n"}, False),
    ],
)
def test_reported(rule: str, files: Mapping[str, object], found: bool, tmp_path: Path) -> None:
    package = write_example(files, tmp_path)
    settings = Settings(
        profile="ros2", profile_chosen=True, distro="humble", select=(rule,), trial=False
    )
    (report,) = check_package(package, settings).packages
    assert [finding.rule for finding in report.findings] == [rule] * found
    assert (rule in {each.rule for each in report.not_checked}) is not found
