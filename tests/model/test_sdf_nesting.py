"""Models in models: nested, included, renamed, merged, placed by a frame of theirs."""

from __future__ import annotations

import numpy as np
import pytest

from checker.formats.sdf.reader import MAX_INCLUDES
from checker.model.faults import FaultKind
from tests.model.robots import assert_pose, messages, pose, sdf

A_TEXT, A = "1 2 3 0.1 0.2 0.3", pose(1, 2, 3, 0.1, 0.2, 0.3)
B_TEXT, B = "-1 0.5 0.25 -0.4 0.5 0.6", pose(-1, 0.5, 0.25, -0.4, 0.5, 0.6)
C_TEXT, C = "0.3 -0.2 2 0.7 -0.8 0.9", pose(0.3, -0.2, 2, 0.7, -0.8, 0.9)

ARM = f"""<sdf version="1.7"><model name="arm"><pose>{A_TEXT}</pose>
    <link name="wrist"><pose>{B_TEXT}</pose></link>
    <frame name="grip" attached_to="wrist"><pose>{C_TEXT}</pose></frame>
    <plugin name="p" filename="f"/></model></sdf>"""
FILES = {"arm": ARM}


def test_nested_models_carry_their_links() -> None:
    robot = sdf(
        f"""<model name="a"><pose>{A_TEXT}</pose><model name="b"><pose>{B_TEXT}</pose>
        <link name="c"><pose>{C_TEXT}</pose></link>
        <link name="d"><pose relative_to="__model__">{C_TEXT}</pose></link></model></model>
        <link name="e"><pose relative_to="a::b::c">{A_TEXT}</pose></link>
        <joint name="j" type="fixed"><parent>e</parent><child>a::b::c</child></joint>""",
        "1.8",
    )
    assert messages(robot) == []
    assert [link.scoped_name for link in robot.links] == ["a::b::c", "a::b::d", "e"]
    assert [model.scoped_name for model in robot.models] == ["a::b", "a"]
    assert_pose(robot.pose_of("a::b"), A @ B)
    assert_pose(robot.pose_of("a::b::c"), A @ B @ C)
    assert_pose(robot.pose_of("a::b::d"), A @ B @ C)
    assert_pose(robot.pose_of("e"), A @ B @ C @ A)
    assert_pose(robot.pose_of("j"), A @ B @ C)


def test_placement_frame_stands_at_the_pose() -> None:
    robot = sdf(
        f"""<model name="a" placement_frame="c"><pose>{A_TEXT}</pose>
        <link name="b"><pose relative_to="c">{B_TEXT}</pose></link>
        <link name="c"><pose>{C_TEXT}</pose></link></model>""",
        "1.8",
    )
    assert_pose(robot.pose_of("a::c"), A)
    assert_pose(robot.pose_of("a"), A @ np.linalg.inv(C))
    assert_pose(robot.pose_of("a::b"), A @ B)


def test_an_unknown_placement_frame_is_a_fault() -> None:
    robot = sdf('<model name="a" placement_frame="x"><link name="b"/></model>', "1.8")
    assert messages(robot) == ["placement frame 'x' does not exist in the model"]


def test_an_include_is_placed_by_its_own_pose_else_by_the_model() -> None:
    robot = sdf(
        f"""<include><uri>arm</uri></include>
        <include><uri>arm</uri><name>left</name><pose>{C_TEXT}</pose></include>""",
        "1.8",
        FILES,
    )
    assert_pose(robot.pose_of("arm::wrist"), A @ B)
    assert_pose(robot.pose_of("left::wrist"), C @ B)
    assert_pose(robot.pose_of("left::grip"), C @ B @ C)
    assert [plugin.nested_in for plugin in robot.plugins] == ["arm", "left"]


def test_an_include_may_choose_the_placement_frame() -> None:
    robot = sdf(
        f"""<include><uri>arm</uri><pose>{C_TEXT}</pose>
        <placement_frame>grip</placement_frame></include>""",
        "1.8",
        FILES,
    )
    assert_pose(robot.pose_of("arm::grip"), C)
    assert_pose(robot.pose_of("arm"), C @ np.linalg.inv(B @ C))


def test_a_merged_include_shares_the_names() -> None:
    robot = sdf(
        f"""<link name="base"><pose relative_to="wrist">{A_TEXT}</pose></link>
        <include merge="true"><uri>arm</uri><pose>{C_TEXT}</pose></include>""",
        "1.9",
        FILES,
    )
    assert messages(robot) == []
    assert [link.scoped_name for link in robot.links] == ["base", "wrist"]
    assert_pose(robot.pose_of("wrist"), C @ B)
    assert_pose(robot.pose_of("base"), C @ B @ A)


def test_each_file_is_read_in_its_own_version() -> None:
    old = f"""<sdf version="1.6"><model name="m"><link name="a"><pose>{A_TEXT}</pose></link>
        <link name="b"><pose frame="a">{B_TEXT}</pose></link></model></sdf>"""
    robot = sdf("<include><uri>old</uri></include>", "1.9", {"old": old})
    assert_pose(robot.pose_of("m::b"), A @ B)


def test_an_include_that_is_not_at_hand_is_remembered() -> None:
    robot = sdf("<include><uri>model://gone</uri></include><include/>")
    assert [uri.value for uri in robot.unresolved_includes] == ["model://gone", ""]
    assert messages(robot) == []


@pytest.mark.parametrize(
    ("files", "says"),
    [
        ({"a": "<sdf version='1.8'/>"}, "a contains no <model>"),
        ({"a": '<sdf><model name="m"><include><uri>a</uri></include></model></sdf>'}, "itself"),
    ],
)
def test_an_include_that_cannot_be_read_is_a_fault(files: dict[str, str], says: str) -> None:
    (fault,) = sdf("<include><uri>a</uri></include>", "1.8", files).faults
    assert fault.kind is FaultKind.INCLUDE
    assert says in fault.message


def test_includes_that_double_at_each_level_end() -> None:
    twice = '<sdf version="1.8"><model name="m">{0}{0}</model></sdf>'
    files = {f"m{i}": twice.format(f"<include><uri>m{i + 1}</uri></include>") for i in range(39)}
    robot = sdf("<include><uri>m0</uri></include>", "1.8", files)
    assert len(robot.models) <= MAX_INCLUDES
    assert any("more than" in message for message in messages(robot))


def test_models_nested_too_deep_are_a_fault() -> None:
    robot = sdf('<model name="m">' * 60 + "</model>" * 60, "1.8")
    assert messages(robot) == ["models are nested more than 40 levels deep"]


def test_the_frame_of_a_nested_model_has_a_name_outside_of_it() -> None:
    content = f"""<model name="arm"><pose>{B_TEXT}</pose><link name="wrist"/></model>
      <frame name="mount"><pose relative_to="arm::__model__">{C_TEXT}</pose></frame>"""
    robot = sdf(content, "1.8")
    assert not robot.faults
    assert_pose(robot.pose_of("mount"), B @ C)
    assert {"__model__", "arm::__model__"} <= robot.attachable_names
