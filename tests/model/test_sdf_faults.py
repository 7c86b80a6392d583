"""What does not read as it stands: each fault has its place, and the reading goes on."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.faults import FaultKind
from checker.model.frames import FrameGraph, FrameNode
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from tests.effort import grows_linearly, large
from tests.model.robots import assert_pose, document, messages, pose, sdf

NOT_NUMBERS = [
    "1e400",
    "--5",
    "0x10",
    "1,5",
    "nan",
    "1.O1e2",
    "5kg",
    "1e",
    ".",
    "١",
    "1\xa02",
    "1_0",
]


@pytest.mark.parametrize("word", NOT_NUMBERS)
def test_not_a_number(word: str) -> None:
    robot = sdf(f'<link name="a"><inertial><mass>\n {word} </mass></inertial></link>')
    (fault,) = robot.faults
    assert fault.kind is FaultKind.VALUE
    assert fault.span.text == word
    assert str(fault.span.place()) == "model.sdf:2:2"
    assert robot.mass == 0.0


@pytest.mark.parametrize(
    ("word", "value"), [("1", 1), ("-.5", -0.5), ("+5.", 5), ("1e-3", 0.001), ("inf", float("inf"))]
)
def test_a_number(word: str, value: float) -> None:
    robot = sdf(f'<link name="a"><inertial><mass>{word}</mass></inertial></link>')
    assert messages(robot) == []
    assert robot.mass == value


@pytest.mark.parametrize(
    ("numbers", "count"), [("1 2 3 0 0", 5), ("1 2 3 0 0 0 7", 7), ("1 2 3", 3), ("1", 1)]
)
def test_a_pose_has_six_numbers(numbers: str, count: int) -> None:
    robot = sdf(f'<link name="a"><pose>{numbers}</pose></link>')
    (fault,) = robot.faults
    assert fault.message == f"<pose> has {count} values, expected 6 numbers"
    assert fault.span.text == numbers
    expected = pose(1, 2, 3, 0, 0, 0) if count > 1 else pose(1, 0, 0, 0, 0, 0)
    assert_pose(robot.pose_of("a"), expected)


@pytest.mark.parametrize("version", ["1.6", "1.9"])
def test_a_pose_is_finite(version: str) -> None:
    robot = sdf('<link name="a"><pose>0 0 1 inf 0 0</pose></link>', version)
    (fault,) = robot.faults
    assert (fault.message, fault.span.text) == ("a pose has finite numbers only", "inf")
    assert_pose(robot.pose_of("a"), pose(0, 0, 1, 0, 0, 0))


@pytest.mark.parametrize("masses", [("inf", "-inf"), ("1e308", "1e308")])
def test_masses_beyond_all_bounds(masses: tuple[str, str]) -> None:
    inside = "<inertial><mass>{}</mass></inertial>"
    robot = sdf("".join(f"<link>{inside.format(mass)}</link>" for mass in masses))
    assert not math.isfinite(robot.mass)


def test_a_quaternion_of_tiny_numbers_still_turns() -> None:
    inside = '<pose rotation_format="quat_xyzw">0 0 0 0 0 1e-200 1e-200</pose>'
    robot = sdf(f'<link name="a">{inside}</link>', "1.9")
    assert_pose(robot.pose_of("a"), pose(0, 0, 0, 0, 0, math.pi / 2))


def test_a_quaternion_of_zeros_is_a_fault() -> None:
    inside = '<pose rotation_format="quat_xyzw">1 2 3 0 0 0 0</pose>'
    robot = sdf(f'<link name="a">{inside}</link>', "1.9")
    assert messages(robot) == ["a quaternion of zeros is not a rotation"]
    assert_pose(robot.pose_of("a"), pose(1, 2, 3, 0, 0, 0))


def test_a_pose_that_is_empty_is_zero() -> None:
    assert messages(sdf('<link name="a"><pose/></link><link name="b"><pose> </pose></link>')) == []


def test_numbers_over_lines_and_beside_comments_have_their_own_places() -> None:
    robot = sdf('<link name="a"><pose>1 2 <!-- z: --> 3\r\n\t0 x 0</pose></link>')
    (fault,) = robot.faults
    assert fault.message == "'x' is not a number"
    assert str(fault.span.place()) == "model.sdf:2:4"
    assert [number.span.text for number in robot.links[0].pose.numbers] == [*"1230x0"]


def test_a_number_written_by_an_entity_stands_at_the_whole_text() -> None:
    robot = sdf('<link name="a"><pose>&#x31; 2 3 0 0 0</pose></link>')
    assert_pose(robot.pose_of("a"), pose(1, 2, 3, 0, 0, 0))
    assert robot.links[0].pose.numbers[1].span.text == "&#x31; 2 3 0 0 0"


@pytest.mark.parametrize(
    ("content", "says", "marked"),
    [
        (
            '<link name="a"><pose relative_to="b">0 0 0 0 0 0</pose></link>',
            "link 'a' is posed relative to 'b', which does not exist",
            '<pose relative_to="b">',
        ),
        (
            '<frame name="f" attached_to="b"/>',
            "frame 'f' is posed relative to 'b', which does not exist",
            '<frame name="f" attached_to="b"/>',
        ),
        (
            '<link name="a"><collision name="c"><pose relative_to="b"/></collision></link>',
            "collision 'c' is posed relative to 'b', which does not exist",
            '<pose relative_to="b"/>',
        ),
        (
            '<link name="a"/><joint name="j"><child>a</child><axis><xyz expressed_in="b">1 0 0'
            "</xyz></axis></joint>",
            "the axis of joint 'j' is expressed in 'b', which does not exist",
            "<axis>",
        ),
    ],
)
def test_an_unknown_frame(content: str, says: str, marked: str) -> None:
    (fault,) = sdf(content, "1.7").faults
    assert fault.kind is FaultKind.FRAME
    assert fault.message == says
    assert fault.span.text == marked


def ring(count: int) -> str:
    return "".join(
        f'<link name="l{i}"><pose relative_to="l{(i + 1) % count}">0 0 0 0 0 0</pose></link>'
        for i in range(count)
    )


@pytest.mark.parametrize(("count", "circle"), [(1, "l0 → l0"), (2, "l0 → l1 → l0")])
def test_a_small_circle_is_named_whole(count: int, circle: str) -> None:
    robot = sdf(ring(count) + '<link name="z"><pose relative_to="l0"/></link>', "1.7")
    assert messages(robot) == [f"link 'l0' is posed relative to itself: {circle}"]
    assert robot.pose_of("l0") is None
    assert robot.pose_of("z") is None


def test_a_large_circle_is_one_fault() -> None:
    assert messages(sdf(ring(1000), "1.7")) == [
        "link 'l0' is posed relative to itself: l0 → l1 → l2 → l3 → l4 → l5 → …"
    ]


def chain(count: int) -> str:
    """Links l0, l1, … each a metre along x of the joint in front."""
    bases = ["__model__", *(f"j{i}" for i in range(count))]
    return "".join(
        f'<link name="l{i}"><pose relative_to="{bases[i]}">1 0 0 0 0 0</pose></link>'
        f'<joint name="j{i}" type="fixed"><parent>world</parent><child>l{i}</child></joint>'
        for i in range(count)
    )


def test_a_long_chain_of_joints_costs_no_square() -> None:
    def read(count: int) -> None:
        robot = sdf(chain(count), "1.7")
        found = robot.pose_of(f"j{count - 1}")
        assert found is not None
        assert found.translation == (count, 0, 0)

    count = large(2_500)
    assert grows_linearly(lambda: read(count), lambda: read(4 * count))


def test_a_chain_of_50_000_joints_ends_without_recursion() -> None:
    graph, span = FrameGraph(), document("<a/>").root.span
    step = Transform(translation=(1.0, 0.0, 0.0))
    graph.add("f0", FrameNode(None, step, span, "f0"))
    for i in range(1, 50_000):
        graph.add(f"f{i}", FrameNode(f"f{i - 1}", step, span, f"f{i}"))
    found, below = graph.pose("f49999"), graph.pose_below("f49999", "f9999")
    assert found is not None
    assert below is not None
    assert (found.translation, below.translation) == ((50_000, 0, 0), (40_000, 0, 0))


def test_of_two_links_with_one_name_the_first_counts() -> None:
    robot = sdf('<link name="a"><pose>1 0 0 0 0 0</pose></link><link name="a"/>')
    assert len(robot.links) == 2
    assert robot.links_by_name["a"] is robot.links[0]
    assert_pose(robot.pose_of("a"), pose(1, 0, 0, 0, 0, 0))


TAGS = ["link", "joint", "frame", "model", "include", "pose", "inertial", "mass", "axis", "xyz"]
TAGS += ["collision", "visual", "sensor", "geometry", "box", "size", "parent", "child", "plugin"]
TEXTS = st.sampled_from(
    ["", "a", "1", "1 2 3 4 5 6", "1 2 inf inf 5 -inf", "1e308", "x y", "-inf", "true"]
)
ATTRIBUTES = st.sampled_from(
    ["", ' name="a"', ' name=""', ' relative_to="a"', ' attached_to="a"', ' degrees="true"']
)


@st.composite
def elements(draw: st.DrawFn, depth: int = 0) -> str:
    tag = draw(st.sampled_from(TAGS))
    inside = draw(TEXTS)
    if depth < 4:
        inside += "".join(draw(st.lists(elements(depth + 1), max_size=3)))
    return f"<{tag}{draw(ATTRIBUTES)}>{inside}</{tag}>"


@given(st.lists(elements(), max_size=5).map("".join), st.sampled_from(["1.4", "1.6", "1.9", "x"]))
def test_no_model_raises(content: str, version: str) -> None:
    robot = sdf(content, version)
    assert isinstance(robot, Robot)
    for link in robot.links:
        assert link.scoped_name in robot.frame_graph.nodes
        for shape in (*link.collisions, *link.visuals):
            robot.pose_of_part(link, shape.pose)
    for joint in robot.joints:
        for axis in joint.axes:
            direction = robot.axis_in_model(joint, axis)
            assert direction is None or sum(x * x for x in direction) == pytest.approx(1)
