"""Where SDF puts things: each pose worked out by numpy from the numbers in the text."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.model.robots import assert_pose, messages, pose, sdf

# Poses that share no axis, so that a wrong order or direction shows.
A_TEXT, A = "1 2 3 0.1 0.2 0.3", pose(1, 2, 3, 0.1, 0.2, 0.3)
B_TEXT, B = "-1 0.5 0.25 -0.4 0.5 0.6", pose(-1, 0.5, 0.25, -0.4, 0.5, 0.6)
C_TEXT, C = "0.3 -0.2 2 0.7 -0.8 0.9", pose(0.3, -0.2, 2, 0.7, -0.8, 0.9)


def test_links_stand_in_the_model() -> None:
    robot = sdf(f'<pose>9 9 9 1 1 1</pose><link name="a"><pose>{A_TEXT}</pose></link>')
    assert_pose(robot.pose_of("a"), A)


def test_a_comma_behind_a_number_is_left_out() -> None:
    robot = sdf(f'<link name="a"><pose>{A_TEXT.replace(" ", ", ")}</pose></link>')
    assert_pose(robot.pose_of("a"), A)


def test_relative_to_chains() -> None:
    robot = sdf(
        f"""<link name="c"><pose relative_to="b">{C_TEXT}</pose></link>
        <link name="b"><pose relative_to="a">{B_TEXT}</pose></link>
        <link name="a"><pose relative_to="__model__">{A_TEXT}</pose></link>""",
        "1.7",
    )
    assert messages(robot) == []
    assert_pose(robot.pose_of("c"), A @ B @ C)


def test_in_sdf_1_6_the_attribute_is_called_frame() -> None:
    robot = sdf(
        f"""<link name="a"><pose frame="">{A_TEXT}</pose></link>
        <link name="b"><pose frame="a">{B_TEXT}</pose></link>"""
    )
    assert_pose(robot.pose_of("b"), A @ B)


def test_frames_are_posed_in_what_they_are_attached_to() -> None:
    robot = sdf(
        f"""<link name="a"><pose>{A_TEXT}</pose></link>
        <frame name="f" attached_to="a"><pose>{B_TEXT}</pose></frame>
        <frame name="g" attached_to="a"><pose relative_to="__model__">{C_TEXT}</pose></frame>
        <frame name="h"/>
        <link name="b"><pose relative_to="f">{C_TEXT}</pose></link>""",
        "1.7",
    )
    assert_pose(robot.pose_of("f"), A @ B)
    assert_pose(robot.pose_of("g"), C)
    assert_pose(robot.pose_of("h"), np.eye(4))
    assert_pose(robot.pose_of("b"), A @ B @ C)


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.7", "1.12"])
def test_joints_stand_in_their_child(version: str) -> None:
    robot = sdf(
        f"""<joint name="j" type="fixed"><pose>{C_TEXT}</pose>
        <parent>a</parent><child>b</child></joint>
        <link name="a"><pose>{A_TEXT}</pose></link>
        <link name="b"><pose>{B_TEXT}</pose></link>""",
        version,
    )
    assert_pose(robot.pose_of("j"), B @ C)
    assert_pose(robot.pose_of_joint(robot.joints[0]), B @ C)


def test_a_joint_may_be_posed_elsewhere_and_a_link_in_a_joint() -> None:
    robot = sdf(
        f"""<link name="a"><pose>{A_TEXT}</pose></link>
        <joint name="j" type="fixed"><pose relative_to="a">{B_TEXT}</pose>
        <parent>a</parent><child>b</child></joint>
        <link name="b"><pose relative_to="j">{C_TEXT}</pose></link>""",
        "1.7",
    )
    assert messages(robot) == []
    assert_pose(robot.pose_of("j"), A @ B)
    assert_pose(robot.pose_of("b"), A @ B @ C)


@pytest.mark.parametrize("joint_first", [True, False])
def test_a_name_shared_by_joint_and_link_stands_for_the_link(joint_first: bool) -> None:
    joint = f"""<joint name="b" type="fixed"><pose>{C_TEXT}</pose>
        <parent>a</parent><child>b</child></joint>"""
    links = f'<link name="a"/><link name="b"><pose>{B_TEXT}</pose></link>'
    robot = sdf(joint + links if joint_first else links + joint)
    assert messages(robot) == []
    assert_pose(robot.pose_of("b"), B)
    assert_pose(robot.pose_of_joint(robot.joints[0]), B @ C)


def test_parts_stand_in_their_link() -> None:
    robot = sdf(
        f"""<link name="a"><pose>{A_TEXT}</pose>
        <inertial><pose>{B_TEXT}</pose></inertial>
        <collision name="c"><pose>{C_TEXT}</pose></collision>
        <visual name="v"><pose relative_to="b">{C_TEXT}</pose></visual>
        <sensor name="s" type="imu"/><light name="l" type="point"><pose>{B_TEXT}</pose></light>
        </link>
        <link name="b"><pose>{B_TEXT}</pose></link>
        <joint name="j" type="fixed"><pose>{C_TEXT}</pose><parent>a</parent><child>b</child>
        <sensor name="t" type="force_torque"><pose>{A_TEXT}</pose></sensor></joint>""",
        "1.7",
    )
    link, joint = robot.links[0], robot.joints[0]
    assert link.inertial is not None
    assert_pose(robot.pose_of_part(link, link.inertial.pose), A @ B)
    assert_pose(robot.pose_of_part(link, link.collisions[0].pose), A @ C)
    assert_pose(robot.pose_of_part(link, link.visuals[0].pose), B @ C)
    assert_pose(robot.pose_of_part(link, link.sensors[0].pose), A)
    assert_pose(robot.pose_of_part(link, link.lights[0].pose), A @ B)
    assert_pose(robot.pose_of_part(joint, joint.sensors[0].pose), B @ C @ A)


def test_angles_in_degrees() -> None:
    robot = sdf('<link name="a"><pose degrees="true">1 2 3 90 -45 30</pose></link>', "1.9")
    expected = pose(1, 2, 3, math.pi / 2, -math.pi / 4, math.pi / 6)
    assert_pose(robot.pose_of("a"), expected)


def test_quaternions_have_w_last_and_are_normalised() -> None:
    robot = sdf(
        '<link name="a"><pose rotation_format="quat_xyzw">1 2 3 0 0 2 2</pose></link>', "1.9"
    )
    assert messages(robot) == []
    assert_pose(robot.pose_of("a"), pose(1, 2, 3, 0, 0, math.pi / 2))
