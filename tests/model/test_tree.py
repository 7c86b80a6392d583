"""The links of a robot as a tree: what hangs on what, what is loose, what goes in circles."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.robot import Robot
from tests.effort import large, limited
from tests.model.robots import sdf, urdf


def linked(count: int, *ties: tuple[object, object], version: str = "1.6", more: str = "") -> Robot:
    links = "".join(f'<link name="{number}"/>' for number in range(count))
    joints = "".join(
        f'<joint name="j{number}" type="fixed"><parent>{parent}</parent><child>{child}</child>'
        "</joint>"
        for number, (parent, child) in enumerate(ties)
    )
    return sdf(links + joints + more, version)


def ties(robot: Robot) -> list[tuple[str, str]]:
    return [(tie.parent, tie.child) for tie in robot.tree.ties]


def loops(robot: Robot) -> list[set[str]]:
    return [{tie.child for tie in loop} for loop in robot.tree.loops()]


def test_a_sound_robot_is_one_group_without_loops() -> None:
    robot = linked(4, (0, 1), (1, 2), (0, 3))
    assert robot.tree.groups == [["0", "1", "2", "3"]]
    assert loops(robot) == []
    assert set(robot.tree.ties_above) == {"1", "2", "3"}


def test_what_nothing_ties_is_a_group_of_its_own() -> None:
    assert linked(4, (2, 3)).tree.groups == [["0"], ["1"], ["2", "3"]]


def test_the_world_ties_what_hangs_on_it() -> None:
    assert linked(2, ("world", 0), ("world", 1)).tree.groups == [["0", "1"]]


def test_each_loop_is_found_once() -> None:
    robot = linked(7, (0, 1), (1, 0), (2, 3), (3, 4), (4, 2), (4, 5), (5, 6))
    assert loops(robot) == [{"0", "1"}, {"2", "3", "4"}]


def test_a_tie_to_itself_is_no_loop() -> None:
    robot = linked(1, (0, 0))
    assert ties(robot) == [("0", "0")]
    assert loops(robot) == []


@pytest.mark.parametrize(
    ("parent", "child", "missing", "known"),
    [(0, "x", "x", "0"), ("x", 0, "x", "0"), ("y", "x", "x", None), ("world", "x", "x", "world")],
)
def test_a_joint_with_an_unknown_end_ties_nothing(
    parent: object, child: object, missing: str, known: str | None
) -> None:
    robot = linked(1, (parent, child))
    (broken,) = robot.tree.broken
    assert ties(robot) == []
    assert (broken.missing.value, broken.known) == (missing, known)


FRAMES = """
<frame name="top" attached_to="0"/>
<frame name="tip" attached_to="top"/>
<frame name="base" attached_to="__model__"/>
<frame name="round" attached_to="about"/><frame name="about" attached_to="round"/>
<model name="arm" canonical_link="hand"><link name="wrist"/><link name="hand"/></model>
"""


@pytest.mark.parametrize(
    ("end", "link"),
    [("tip", "0"), ("base", "0"), ("arm::hand", "arm::hand"), ("arm", "arm::hand"), ("j0", "1")],
)
def test_a_joint_ties_the_link_that_carries_a_frame(end: str, link: str) -> None:
    robot = linked(3, (0, 1), (end, 2), version="1.7", more=FRAMES)
    assert ties(robot)[1] == (link, "2")


def test_frames_that_are_attached_in_a_circle_carry_nothing() -> None:
    robot = linked(2, ("round", 1), version="1.7", more=FRAMES)
    assert ties(robot) == []


@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), max_size=12))
def test_groups_and_loops_agree_with_a_search(pairs: list[tuple[int, int]]) -> None:
    robot = linked(7, *pairs)
    near: dict[int, set[int]] = {number: {number} for number in range(7)}
    for parent, child in pairs:
        near[parent].add(child)
        near[child].add(parent)
    for _ in range(7):
        near = {one: set().union(*(near[other] for other in near[one])) for one in near}
    assert {frozenset(group) for group in robot.tree.groups} == {
        frozenset(map(str, group)) for group in near.values()
    }
    above = {name: found[0].parent for name, found in robot.tree.ties_above.items()}
    circling = set()
    for name, parent in above.items():
        at: str | None = parent
        for _ in range(7):
            if at == name:
                circling.add(name)
            at = above.get(at) if at is not None else None
    assert set().union(*loops(robot)) == circling


@pytest.mark.slow
def test_a_long_loop_takes_no_more_than_seconds() -> None:
    count = large(20_000)
    with limited(20):
        robot = linked(count, *((number, (number + 1) % count) for number in range(count)))
        (found,) = loops(robot)
        assert len(found) == count
        assert len(robot.tree.groups) == 1


def test_urdf_ties_links_too() -> None:
    robot = urdf(
        '<link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    )
    assert ties(robot) == [("a", "b")]
