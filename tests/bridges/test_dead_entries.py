"""Bridges of topics that Gazebo does not have, where nothing is missing for it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings

_COMMAND = """- topic_name: /cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
"""
_CONTROLLERS = """controller_manager:
  ros__parameters:
    base: {type: ackermann_steering_controller/AckermannSteeringController}
base:
  ros__parameters: {use_stamped_vel: false}
"""
_STARTED = """Node(package="controller_manager", executable="ros2_control_node",
     parameters=[os.path.join(HERE, "config", "base.yaml")]),
Node(package="controller_manager", executable="spawner", arguments=["base"]),
"""
_HEAD = "LaunchDescription([\n"


def found(example: Mapping[str, object], folder: Path) -> list[tuple[str, str]]:
    """Return severity and message of each finding of BRG004."""
    settings = Settings(select=("BRG004",), distro="humble", trial=False)
    reports = check_package(write_example(example, folder), settings).packages
    return [(str(it.severity), it.message) for report in reports for it in report.findings]


@pytest.mark.parametrize(
    ("passing", "severity"),
    [
        ('arguments=["/cmd_vel", "/base/reference_unstamped"]', "info"),
        ('remappings=[("in", "/cmd_vel"), ("out", "/base/reference_unstamped")]', "info"),
        ('arguments=["/cmd_vel", "/lift/reference_unstamped"]', "warning"),
        ('arguments=["/joy", "/base/reference_unstamped"]', "warning"),
    ],
)
def test_a_command_that_a_node_passes_on(passing: str, severity: str, tmp_path: Path) -> None:
    relay = f'Node(package="topic_tools", executable="relay", {passing}),\n'
    example = {
        "@bridge": _COMMAND,
        "@launch": {_HEAD: _HEAD + _STARTED + relay},
        "config/base.yaml": _CONTROLLERS,
    }

    ((said, message),) = found(example, tmp_path)

    assert said == severity
    assert ("controller 'base'" in message) is (severity == "info")


_XACRO = """<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="ns" default=""/>
  <xacro:arg name="lidar" default="true"/>
  <link name="base_link"/>
  <xacro:if value="$(arg lidar)">
    <gazebo reference="base_link">
      <sensor name="lidar" type="gpu_lidar"><topic>$(arg ns)/scan</topic></sensor>
    </gazebo>
  </xacro:if>
  <gazebo reference="base_link">
    <sensor name="imu" type="imu"><topic>$(arg ns)/imu</topic></sensor>
  </gazebo>
</robot>
"""
_LAUNCH = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node

HERE = get_package_share_directory("acme_rover_bringup")
URDF = os.path.join(HERE, "urdf", "rover.urdf.xacro")


def robot(name, lidar):
    about = Command(["xacro ", URDF, " ns:=", name, " lidar:=", lidar])
    return [
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             namespace=name, parameters=[{"robot_description": about}]),
        Node(package="ros_gz_sim", executable="create",
             arguments=["-name", "rover" + name, "-topic", name + "/robot_description"]),
        Node(package="ros_gz_bridge", executable="parameter_bridge", arguments=[
            name + "/imu@sensor_msgs/msg/Imu[gz.msgs.IMU",
            name + "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"]),
    ]


def generate_launch_description():
    gazebo = os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py")
    return LaunchDescription([
        IncludeLaunchDescription(gazebo, launch_arguments=[("gz_args", "-r empty.sdf")]),
        ROBOTS
    ])
"""


@pytest.mark.parametrize(
    ("robots", "alone", "severities"),
    [
        ('*robot("/r1", "true"), *robot("/r2", "true")', "", []),
        ('*robot("/r1", "false"), *robot("/r2", "true")', "", ["warning"]),
        ('*robot("/r1", "false"), *robot("/r2", "false")', '*robot("", "true")', ["info", "info"]),
    ],
)
def test_two_robots_of_one_file(
    robots: str, alone: str, severities: list[str], tmp_path: Path
) -> None:
    example = {
        "@bridge": "[]",
        "launch/rover.launch.py": _LAUNCH.replace("ROBOTS", alone),
        "launch/two.launch.py": _LAUNCH.replace("ROBOTS", robots),
        "urdf/rover.urdf": None,
        "urdf/rover.urdf.xacro": _XACRO,
    }

    assert [severity for severity, _ in found(example, tmp_path)] == severities
