"""Which way a joint's axis points, in every version's way of saying it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.model.robots import messages, pose, sdf, urdf

CHILD_TEXT, CHILD = "0 0 0 0.1 0.2 0.3", pose(0, 0, 0, 0.1, 0.2, 0.3)
JOINT_TEXT, JOINT = "0 0 0 -0.4 0.5 0.6", pose(0, 0, 0, -0.4, 0.5, 0.6)
XYZ = np.array([2.0, 1.0, -2.0]) / 3
OWN = (CHILD @ JOINT)[:3, :3] @ XYZ


def axis_of(version: str, axis: str) -> np.ndarray:
    robot = sdf(
        f"""<link name="a"/><link name="b"><pose>{CHILD_TEXT}</pose></link>
        <joint name="j" type="revolute"><pose>{JOINT_TEXT}</pose>
        <parent>a</parent><child>b</child><axis>{axis}</axis></joint>""",
        version,
    )
    assert messages(robot) == []
    direction = robot.axis_in_model(robot.joints[0], robot.joints[0].axes[0])
    assert direction is not None
    return np.array(direction)


@pytest.mark.parametrize(
    ("version", "axis", "expected"),
    [
        ("1.4", "<xyz>2 1 -2</xyz>", XYZ),
        ("1.5", "<xyz>2 1 -2</xyz>", OWN),
        ("1.6", "<xyz>2 1 -2</xyz>", OWN),
        ("1.6", "<xyz>2 1 -2</xyz><use_parent_model_frame>0</use_parent_model_frame>", OWN),
        ("1.6", "<xyz>2 1 -2</xyz><use_parent_model_frame>1</use_parent_model_frame>", XYZ),
        ("1.5", "<xyz>2 1 -2</xyz><use_parent_model_frame>true</use_parent_model_frame>", XYZ),
        ("1.7", "<xyz>2 1 -2</xyz>", OWN),
        ("1.7", '<xyz expressed_in="__model__">2 1 -2</xyz>', XYZ),
        ("1.7", '<xyz expressed_in="b">2 1 -2</xyz>', CHILD[:3, :3] @ XYZ),
        ("1.7", '<xyz expressed_in="j">2 1 -2</xyz>', OWN),
        ("1.6", "", (CHILD @ JOINT)[:3, 2]),
    ],
)
def test_direction_in_the_robot(version: str, axis: str, expected: np.ndarray) -> None:
    np.testing.assert_allclose(axis_of(version, axis), expected, atol=1e-12)


def test_the_model_of_a_nested_joint_is_the_nested_one() -> None:
    robot = sdf(
        f"""<model name="m"><pose>{CHILD_TEXT}</pose><link name="a"/>
        <link name="b"><pose>{JOINT_TEXT}</pose></link>
        <joint name="j" type="revolute"><parent>a</parent><child>b</child><axis>
        <xyz expressed_in="__model__">2 1 -2</xyz></axis></joint></model>""",
        "1.7",
    )
    found = robot.axis_in_model(robot.joints[0], robot.joints[0].axes[0])
    np.testing.assert_allclose(found, CHILD[:3, :3] @ XYZ, atol=1e-12)


def test_a_urdf_axis_turns_with_its_child() -> None:
    robot = urdf(
        """<link name="a"/><link name="b"/><joint name="b" type="revolute">
        <origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><parent link="a"/><child link="b"/>
        <axis xyz="2 1 -2"/></joint>"""
    )
    found = robot.axis_in_model(robot.joints[0], robot.joints[0].axes[0])
    np.testing.assert_allclose(found, CHILD[:3, :3] @ XYZ, atol=1e-12)


@pytest.mark.parametrize("xyz", ["<xyz>0 0 0</xyz>", '<xyz expressed_in="x">1 0 0</xyz>'])
def test_an_axis_without_direction(xyz: str) -> None:
    robot = sdf(
        f"""<link name="b"/><joint name="j" type="revolute"><parent>world</parent>
        <child>b</child><axis>{xyz}</axis></joint>""",
        "1.7",
    )
    assert robot.axis_in_model(robot.joints[0], robot.joints[0].axes[0]) is None


def test_limits() -> None:
    robot = sdf(
        """<link name="b"/><joint name="j" type="revolute2"><parent>world</parent><child>b</child>
        <axis><limit><lower>-1e16</lower><upper>1.5</upper><effort>-1</effort></limit></axis>
        <axis2><limit><lower>-2</lower><velocity>3</velocity></limit></axis2></joint>"""
    )
    first, second = robot.joints[0].axes
    assert (first.lower.value, first.upper.value) == (-math.inf, 1.5)
    assert (first.effort.value, first.velocity.value) == (math.inf, math.inf)
    assert (second.lower.value, second.upper.value, second.velocity.value) == (-2, math.inf, 3)
