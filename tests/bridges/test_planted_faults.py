"""Faults planted one by one in bridges of real packages; without them, nothing is reported."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings
from support.real_packages import MODERN, needed_folder, needs

pytestmark = needs(MODERN)

NAV2 = "nav2_minimal_turtlebot_simulation"
WAFFLE = f"{NAV2}/nav2_minimal_tb3_sim/configs/turtlebot3_waffle_bridge.yaml"
TURTLEBOT_4 = f"{NAV2}/nav2_minimal_tb4_sim/configs/tb4_bridge.yaml"
EXAMPLE = "ros_gz_project_template/ros_gz_example_bringup/config/ros_gz_example_bridge.yaml"
CREATE = (
    "create3_sim/irobot_create_gz/irobot_create_gz_bringup/launch/create3_ros_gz_bridge.launch.py"
)
BURGER = "turtlebot3_simulations/turtlebot3_gazebo/params/turtlebot3_burger_bridge.yaml"
DEMO = "gz_ros2_control/gz_ros2_control_demos/launch/diff_drive_example.launch.py"
LASER = 'ros_type_name: "sensor_msgs/msg/LaserScan"\n  gz_type_name: "gz.msgs.LaserScan"\n'
CLOCK = """- ros_topic_name: "/clock"
  gz_topic_name: "/clock"
  ros_type_name: "rosgraph_msgs/msg/Clock"
  gz_type_name: "gz.msgs.Clock"
  direction: GZ_TO_ROS
"""
DESCRIPTION = "parameters=[{'robot_description': text"
STATIC_POSES = (
    'pose_static"\n  ros_type_name: "tf2_msgs/msg/TFMessage"\n  gz_type_name: "gz.msgs.Pose_V"'
)

FAULTS = [
    (WAFFLE, "gz.msgs.LaserScan", "gz.msgs.Laserscan", "BRG002 error 37"),
    (WAFFLE, "sensor_msgs/msg/LaserScan", "sensor_msgs/LaserScan", "BRG002 error 36"),
    (WAFFLE, "gz.msgs.IMU", "ign_msgs.IMU", "BRG002 error 31"),
    (WAFFLE, "sensor_msgs/msg/Imu", "sensor_msgs/msg/LaserScan", "BRG002 error 30"),
    (WAFFLE, "gz.msgs.LaserScan", "gz.msgs.PointCloudPacked", "BRG003 error 37"),
    (WAFFLE, "gz.msgs.Odometry", "gz.msgs.OdometryWithCovariance", "BRG003 error 17"),
    (WAFFLE, 'topic_name: "scan"', 'topic_name: "lidar"', "BRG004 warning 35"),
    (WAFFLE, 'topic_name: "odom"', 'topic_name: "odometry"', "BRG004 warning 15"),
    (WAFFLE, 'topic_name: "imu"', 'topic_name: "imu/data"', "BRG004 warning 29"),
    (WAFFLE, "direction: ROS_TO_GZ", "direction: GZ_TO_ROS", "BRG005 warning 44"),
    (WAFFLE, f"{LASER}  direction: GZ_TO", f"{LASER}  direction: ROS_TO_GZ #", "BRG005 warning 38"),
    (WAFFLE, f"{LASER}  direction: GZ", f"{LASER}  direction: BIDIRECTIONAL #", "BRG005 info 38"),
    (WAFFLE, "direction: ROS_TO_GZ", "direction: ROS_TO_IGN", "BRG006 error 44"),
    (WAFFLE, "direction: ROS_TO_GZ", "dir: ROS_TO_GZ", "BRG006 warning 44"),
    (WAFFLE, '  ros_type_name: "nav_msgs/msg/Odometry"\n', "", "BRG006 error 15"),
    (WAFFLE, '"scan"\n', '"scan"\n  ros_topic_name: scan\n', "BRG006 error 35"),
    (WAFFLE, '"joint_states"', '"joint-states"', "BRG004 warning 8, BRG007 error 8"),
    (TURTLEBOT_4, "gz.msgs.CameraInfo", "gz.msgs.Camera_Info", "BRG002 error 57"),
    (TURTLEBOT_4, '"/rgbd_camera/', '"/3d_camera/', "BRG007 error 54"),
    (EXAMPLE, "/model/diff_drive/odometry", "/model/diffdrive/odometry", "BRG004 warning 13"),
    (EXAMPLE, "/world/demo/", "/world/empty/", "BRG004 warning 23"),
    (EXAMPLE, 'gz_topic_name: "/scan"', 'gz_topic_name: "/lidar"', "BRG004 warning 18"),
    (EXAMPLE, STATIC_POSES, STATIC_POSES.replace("Pose_V", "Pose"), "BRG003 error 35"),
    (EXAMPLE, CLOCK, "", "BRG008 warning 28"),
    (EXAMPLE, 'ros_topic_name: "/clock"', 'ros_topic_name: "/sim/clock"', "BRG008 warning 28"),
    (EXAMPLE, "---\n", "---\nbridges:\n", "BRG006 error 2"),
    (CREATE, "[ignition.msgs.Pose_V'", "[ignition.msgs.PoseV'", "BRG002 error 18"),
    (CREATE, "'@std_msgs/msg/Int32[", "'[std_msgs/msg/Int32[", "BRG001 error 18"),
    (CREATE, "twist + '[ignition.msgs.Twist'", "twist", "BRG001 error 18"),
    (BURGER, "gz.msgs.Model", "gz.msgs.JointState", "BRG002 warning 12"),
    (BURGER, "direction: ROS_TO_GZ", "direction: TO_GZ", "BRG006 error 34"),
    (DEMO, DESCRIPTION, f"{DESCRIPTION}, 'use_sim_time': True", "BRG008 warning 21"),
]


def reported(package: Path) -> str:
    """Return what the rules about bridges say: rules, severities and lines."""
    settings = Settings(profile="ros2", profile_chosen=True, trial=False, select=("BRG",))
    findings = [
        found for each in check_package(package, settings).packages for found in each.findings
    ]
    said = {f"{it.rule} {it.severity.value} {it.places[0].line}" for it in findings}
    return ", ".join(sorted(said))


def package_of(file: str, folder: Path) -> tuple[Path, Path]:
    """Copy the packages beside one of a file; return the package and the file."""
    parts = Path(file).parts
    above = parts[:-3]
    copy = folder / above[-1]
    shutil.copytree(needed_folder(MODERN) / Path(*above), copy, copy_function=shutil.copyfile)
    for each in (copy, *copy.rglob("*")):
        each.chmod(0o755)
    return copy / parts[-3], copy / Path(*parts[-3:])


@pytest.mark.parametrize("file", sorted({fault[0] for fault in FAULTS}))
def test_nothing_is_reported_of_the_real_package(file: str, tmp_path: Path) -> None:
    package, _ = package_of(file, tmp_path)

    assert reported(package) == ""


@pytest.mark.parametrize(("file", "old", "new", "expected"), FAULTS)
def test_a_fault_is_reported(file: str, old: str, new: str, expected: str, tmp_path: Path) -> None:
    package, changed = package_of(file, tmp_path)
    text = changed.read_text("utf-8")
    assert old in text
    changed.write_text(text.replace(old, new, 1), "utf-8")

    assert reported(package) == expected
