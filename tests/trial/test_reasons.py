"""Why a robot is not driven: the report names the plugin or controller that moves it."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.model.locomotion.commanded_joints import commanded_joints
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from tests.model.robots import sdf, urdf
from tests.model.test_controlled_drives import robot

BODY = """<link name="base"/><link name="part_wheel"><collision><origin rpy="1.5708 0 0"/><geometry>
<cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<joint name="part" type="continuous"><parent link="base"/><child link="part_wheel"/>
<axis xyz="0 1 0"/></joint>"""


def why(robot: Robot) -> str:
    return plan_of(robot).not_driven


def plugin(library: str, content: str = "") -> str:
    return f'<gazebo><plugin name="any" filename="{library}">{content}</plugin></gazebo>'


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (plugin("libgazebo_ros_planar_move.so"), "planar_move sets the body's velocity"),
        ('<ros2_control><joint name="part"/></ros2_control>', "hardware of 1 joint, and"),
        ('<transmission><joint name="part"/></transmission>', "1 transmission for controllers"),
        ("", "name nothing that turns its wheels part_wheel"),
    ],
)
def test_what_moves_a_robot_of_urdf(content: str, reason: str) -> None:
    assert reason in why(urdf(BODY + content))


def test_joints_that_an_unknown_plugin_moves() -> None:
    moved = """<link name="base"/><link name="arm"/><joint name="j" type="revolute">
<parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis></joint>
<plugin filename="p" name="acme::{}"><joint_name>j</joint_name></plugin>"""
    assert why(sdf(moved.format("Hand"))).startswith("its joints are moved by Hand; none")
    assert not why(sdf(moved.format("JointPositionController")))


def test_a_body_whose_velocity_a_plugin_sets() -> None:
    plugin = '<plugin filename="p" name="gz::sim::systems::VelocityControl"/>'
    assert "VelocityControl sets the body's velocity" in why(sdf(f'<link name="base"/>{plugin}'))


@pytest.mark.parametrize(
    ("topic", "drives"),
    [
        ("", False),
        ("<commandTopic>/cmd_vel</commandTopic>", False),
        ("<commandTopic>a</commandTopic>", True),
    ],
)
def test_wheels_of_a_body_whose_velocity_a_plugin_sets(topic: str, drives: bool) -> None:
    other = BODY.replace("part", "other").replace('<link name="base"/>', "")
    wheels = "<leftJoint>part</leftJoint><rightJoint>other</rightJoint>"
    drive = plugin("libgazebo_ros_diff_drive.so", wheels)
    plan = plan_of(urdf(BODY + other + drive + plugin("libgazebo_ros_planar_move.so", topic)))
    assert bool(plan.speeds) is drives
    assert ("planar_move sets the body's velocity" in plan.not_driven) is not drives


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        (
            "joint_trajectory_controller/JointTrajectoryController",
            "'base' names no joint of the model",
        ),
        ("diff_drive_controller/DiffDriveController", "DiffDriveController 'base' names no wheel"),
        ("joint_state_broadcaster/JointStateBroadcaster", "configures no controller"),
    ],
)
def test_controllers(tmp_path: Path, kind: str, reason: str) -> None:
    assert reason in why(robot(tmp_path, kind, "    joints: [rear_left]\n"))


@pytest.mark.parametrize("interface", ["velocity", "effort"])
def test_a_controller_whose_gains_are_0_moves_no_joint(tmp_path: Path, interface: str) -> None:
    kind = "joint_trajectory_controller/JointTrajectoryController"
    parameters = f"    joints: [rear_left]\n    command_interfaces: [{interface}]\n"
    assert "has gains of 0" in why(robot(tmp_path / "bad", kind, parameters))
    gains = "    gains: {rear_left: {p: 3.0}}\n"
    assert commanded_joints(robot(tmp_path / "good", kind, parameters + gains))


def test_a_controller_of_an_own_class_names_joints_by_its_own_parameters(tmp_path: Path) -> None:
    own = why(robot(tmp_path, "acme_control/Steering", "    wheel_joints: [rear_left]\n"))
    assert "'base' commands joints in a way that the trial does not know" in own


def test_nothing_moves_a_crate() -> None:
    assert not why(sdf('<link name="base"/>'))
