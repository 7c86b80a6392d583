"""URDF: poses by joints, and files in which something is missing."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.base.cache import NO_CACHE
from checker.base.parts import WorkerFailed
from checker.formats.urdf.reader import read_urdf
from checker.formats.urdf.second_reading import read_again
from checker.model.robot import Robot
from tests.model.robots import assert_pose, document, messages, pose, urdf

A, B = pose(1, 2, 3, 0.1, 0.2, 0.3), pose(-1, 0.5, 0, -0.4, 0.5, 0.6)
A_ORIGIN = '<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'
B_ORIGIN = '<origin xyz="-1 0.5 0" rpy="-0.4 0.5 0.6"/>'


def joint(name: str, parent: str, child: str, inside: str = "", type: str = "fixed") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{type}">{ends}{inside}</joint>'


def links(*names: str) -> str:
    return "".join(f'<link name="{name}"/>' for name in names)


def test_a_link_stands_where_its_joint_puts_it() -> None:
    robot = urdf(
        links("c", "b", "a") + joint("k", "b", "c", B_ORIGIN) + joint("j", "a", "b", A_ORIGIN)
    )
    assert messages(robot) == []
    assert_pose(robot.pose_of("b"), A)
    assert_pose(robot.pose_of("c"), A @ B)
    assert_pose(robot.pose_of("k"), A @ B)


def test_a_joint_may_have_the_name_of_a_link() -> None:
    robot = urdf(
        links("a", "b", "c") + joint("a", "a", "b", A_ORIGIN) + joint("b", "b", "c", B_ORIGIN)
    )
    assert messages(robot) == []
    assert_pose(robot.pose_of("b"), A)
    assert_pose(robot.pose_of_joint(robot.joints[1]), A @ B)


def test_parts_stand_in_their_link() -> None:
    robot = urdf(
        f"""<link name="a"/><link name="b"><visual>{B_ORIGIN}<geometry><box size="1 2 3"/>
        </geometry></visual></link>{joint("j", "a", "b", A_ORIGIN)}
        <gazebo reference="b"><sensor name="s" type="imu"><pose>-1 0.5 0 -0.4 0.5 0.6</pose>
        </sensor></gazebo>"""
    )
    link = robot.links_by_name["b"]
    assert_pose(robot.pose_of_part(link, link.visuals[0].pose), A @ B)
    assert_pose(robot.pose_of_part(link, link.sensors[0].pose), A @ B)


def test_two_roots_both_stand_in_the_model() -> None:
    robot = urdf(links("a", "b", "c") + joint("j", "a", "b", A_ORIGIN))
    assert_pose(robot.pose_of("a"), pose(0, 0, 0, 0, 0, 0))
    assert_pose(robot.pose_of("c"), pose(0, 0, 0, 0, 0, 0))


def test_a_link_without_inertial_weighs_nothing() -> None:
    robot = urdf('<link name="a"/><link name="b"><inertial><mass value="2"/></inertial></link>')
    assert robot.mass == 2


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (
            links("b") + joint("j", "a", "b"),
            "joint 'j' is posed relative to 'a', which does not exist",
        ),
        (
            links("a") + joint("j", "a", "b"),
            "joint 'j' is posed relative to 'b', which does not exist",
        ),
        (links("a") + '<joint name="j"/>', "joint 'j' is posed relative to nothing"),
        (
            links("a", "b") + joint("j", "a", "b") + joint("k", "b", "a"),
            "joint 'k' is posed relative to itself: a → b → a",
        ),
        (links("a") + joint("j", "a", "a"), "joint 'j' is posed relative to itself: a → a"),
    ],
)
def test_joints_that_lead_nowhere(content: str, says: str) -> None:
    assert messages(urdf(content)) == [says]


def test_a_fault_in_a_sensor_is_told_once() -> None:
    sensor = '<gazebo reference="a"><sensor name="s"><pose>x 0 0 0 0 0</pose></sensor></gazebo>'
    assert messages(urdf(links("a", "b", "c") + sensor)) == ["'x' is not a number"]


def test_limits() -> None:
    limit = '<limit upper="1" effort="2" velocity="3"/>'
    robot = urdf(
        links("a", "b", "c", "d")
        + joint("j", "a", "b", limit, "revolute")
        + joint("k", "a", "c", limit.replace('upper="1"', ""), "continuous")
        + joint("l", "a", "d")
    )
    (revolute,), (continuous,), fixed = (joint.axes for joint in robot.joints)
    assert (revolute.lower.value, revolute.upper.value) == (0, 1)
    assert (continuous.lower.value, continuous.upper.value) == (-math.inf, math.inf)
    assert (continuous.effort.value, continuous.velocity.value) == (2, 3)
    assert [number.value for number in revolute.xyz] == [1, 0, 0]
    assert fixed == ()


def assert_agreed(paths: list[Path]) -> None:
    robots = [read_urdf(document(path.read_text("utf-8"), path.name)) for path in paths]
    readings = read_again(robots, NO_CACHE)
    assert not isinstance(readings, WorkerFailed)
    assert [(it.error, it.differences) for it in readings] == [("", ())] * len(paths)


@pytest.mark.slow
def test_yourdfpy_agrees_on_the_samples(samples: Path) -> None:
    sound = [path for path in samples.rglob("*.urdf") if "broken" not in str(path)]
    assert len(sound) > 1
    assert_agreed([path for path in sound if path.read_text("utf-8").strip()])


def test_yourdfpy_agrees_on_real_packages(corpus: Path) -> None:
    paths = [path for path in corpus.rglob("*.urdf") if path.read_text("utf-8").strip()]
    assert len(paths) == 3
    assert_agreed(paths)


def test_differences_between_readers_name_the_part() -> None:
    whole = urdf(links("a", "b") + joint("j", "a", "b", A_ORIGIN))
    other = urdf(links("a", "b", "c") + joint("j", "a", "b", B_ORIGIN))
    readings = read_again([replace(other, document=whole.document)], NO_CACHE)
    assert not isinstance(readings, WorkerFailed)
    missing, moved = readings[0].differences
    assert (missing.part.name.value, missing.words) == ("c", "reads no such link")
    assert moved.part.name.value == "b"
    assert moved.words.startswith(("places it", "turns it"))


TAGS = [
    "link",
    "joint",
    "origin",
    "inertial",
    "mass",
    "inertia",
    "axis",
    "limit",
    "parent",
    "child",
]
TAGS += ["visual", "collision", "geometry", "box", "mesh", "material", "color", "gazebo", "sensor"]
ATTRIBUTES = [
    "",
    ' name="a"',
    ' link="a"',
    ' link=""',
    ' xyz="1 2"',
    ' rpy="x inf z"',
    ' value="-"',
]
ATTRIBUTES += [' reference="a"', ' type="revolute"', ' size=""', ' rgba="1 1"', ' lower="nan"']


@st.composite
def elements(draw: st.DrawFn, depth: int = 0) -> str:
    tag = draw(st.sampled_from(TAGS))
    inside = "".join(draw(st.lists(elements(depth + 1), max_size=3))) if depth < 3 else ""
    return f"<{tag}{draw(st.sampled_from(ATTRIBUTES))}>{inside}</{tag}>"


@given(st.lists(elements(), max_size=5).map("".join))
def test_no_robot_raises(content: str) -> None:
    robot = urdf(content)
    assert isinstance(robot, Robot)
    assert math.isfinite(robot.mass)
    for joint in robot.joints:
        for axis in joint.axes:
            direction = robot.axis_in_model(joint, axis)
            assert direction is None or math.hypot(*direction) == pytest.approx(1)
