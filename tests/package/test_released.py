"""Names that ROS distributions have released, and slips of the pen for them."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.released import ReleasedNames, distributions_with, is_of_system
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings


def test_who_has_a_package() -> None:
    assert "jazzy" in distributions_with("robot_state_publisher")
    assert "jazzy" not in distributions_with("gazebo_ros")
    assert "humble" in distributions_with("gazebo_ros")
    assert distributions_with("acme_rover_bringup") == ()
    assert is_of_system("eigen")


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("robot_state_publsher", "robot_state_publisher"),
        ("robot_state_publihser", "robot_state_publisher"),
        ("pcl-ros", "pcl_ros"),
        ("nav2_bringups", "nav2_bringup"),
        ("publisher_robot_state", "robot_state_publisher"),
        ("forward_position_controller", "forward_command_controller"),
        # Packages of a team's own are near to others by chance.
        ("arx_msgs", None),
        ("tb_msgs", None),
        ("acme_rover_bringup", None),
    ],
)
def test_a_slip_of_the_pen(name: str, meant: str | None) -> None:
    assert ReleasedNames("jazzy").correction_of(name) == meant


@pytest.mark.parametrize(("readme", "lacks"), [("For ROS 2 Jazzy.\n", False), ("An arm.\n", True)])
def test_what_the_distribution_does_not_have_is_not_to_be_declared(
    readme: str, lacks: bool, tmp_path: Path
) -> None:
    """Where no file names a distribution, it may be one that has the package."""
    node = "        Node(package='warehouse_ros_mongo', executable='server'),"
    package = write_example({"@ros2": node, "README.md": readme}, tmp_path)
    (report,) = check_package(package, Settings(select=("PKG007",))).packages
    assert any("warehouse_ros_mongo" in found.message for found in report.findings) is lacks
