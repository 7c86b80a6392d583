"""The table of roslaunch's tags, and attributes that stand outside of their tag."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from checker.launch.ros1.attributes import launch_tags, left_outside
from checker.ros.robot_description import fixed_frames
from tests.launch.conftest import document

NAMES = st.from_regex(r"[a-z][a-z0-9_-]{0,20}", fullmatch=True)
VALUES = st.text("abcXYZ019 _/$()@[].:=-", max_size=40)


def test_tags_name_only_tags_as_children_and_only_their_attributes_as_required():
    tags = launch_tags()
    for tag in tags.values():
        assert tag.children <= tags.keys()
        assert tag.attributes >= set(tag.required)
    assert "if" not in tags["launch"].attributes
    assert "if" in tags["remap"].attributes


@given(st.dictionaries(NAMES, VALUES, min_size=1, max_size=6))
def test_attributes_behind_a_closed_tag_are_found_with_their_places(attributes):
    written = "\n".join(f'{name}="{value}"' for name, value in attributes.items())
    (node,) = document("a.launch", f"<launch><node>\n{written}>\n</node></launch>").root.children
    found = left_outside(node)
    assert {name: located.value for name, located in found.items()} == attributes
    assert all(located.span.text == located.value for located in found.values())


@given(st.text(st.characters(blacklist_characters="<&\0", blacklist_categories=("Cc", "Cs"))))
def test_any_text_inside_a_node_can_be_looked_at(text):
    (node,) = document("a.launch", f"<launch><node>a={text}</node></launch>").root.children
    left_outside(node)


def test_a_tag_with_attributes_of_its_own_has_none_outside():
    (node,) = document("a.launch", '<launch><node if="1">pkg="p"</node></launch>').root.children
    assert left_outside(node) == {}


def test_frames_of_fixed_joints_are_known_where_xacro_does_not_work_out_their_names():
    names = ("$(arg prefix)mast", "${name}/arm", "${side}_wheel", "plain", "$(arg name)/a_${b}")
    joints = "".join(f'<joint type="fixed"><child link="{name}"/></joint>' for name in names)
    moving = '<joint type="continuous"><child link="wheel"/></joint><joint type="fixed"/>'
    robot = document("robot.xacro", f"<robot>{joints}{moving}</robot>")
    assert list(fixed_frames(robot)) == ["mast", "arm", "plain"]
