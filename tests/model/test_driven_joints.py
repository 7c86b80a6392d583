"""Which joints a plugin moves, and what a plugin and a link say about that."""

from __future__ import annotations

import pytest

from tests.model.robots import sdf, urdf

JOINTS = """
<link name="a"/><link name="b"/>
<joint name="arm" type="revolute"><parent>a</parent><child>b</child></joint>
<joint name="leg" type="revolute"><parent>a</parent><child>b</child></joint>
"""


LEFT = "<left_joint>arm</left_joint>"


def plugin(name: str, content: str) -> str:
    return f'<plugin name="p::{name}" filename="p.so">{content}</plugin>'


@pytest.mark.parametrize(
    ("parameters", "driven"),
    [
        (plugin("JointController", "<joint_name>arm</joint_name>"), {"arm"}),
        (plugin("DiffDrive", f"{LEFT}<right_joint>leg</right_joint>"), {"arm", "leg"}),
        (plugin("GimbalControlPlugin", "<pan><joint>arm</joint></pan>"), {"arm"}),
        (plugin("DiffDrive", "<topic>arm</topic>"), set()),
        (plugin("DiffDrive", "<left_joint>nobody</left_joint>"), set()),
        (plugin("JointStatePublisher", "<joint_name>arm</joint_name>"), set()),
        (plugin("OfOurOwn", "<parts><part>leg</part></parts>"), {"leg"}),
        (plugin("OfOurOwn", '<part name="leg"/>'), {"leg"}),
    ],
)
def test_driven_joints(parameters: str, driven: set[str]) -> None:
    assert set(sdf(JOINTS + parameters).driven_joints) == driven


def test_a_plugin_drives_joints_of_its_own_model() -> None:
    inside = JOINTS + plugin("JointController", "<joint_name>arm</joint_name>")
    assert set(sdf(f'<model name="m">{inside}</model>{JOINTS}').driven_joints) == {"m::arm"}


def test_what_stands_at_a_path() -> None:
    (one,) = sdf(plugin("P", '<w n="1"><x>2</x></w><w n="3"><x>4</x><x/></w><x>5</x>')).plugins
    assert [text.value for text in one.at("w/x")] == ["2", "4"]
    assert [text.value for text in one.at("w/@n")] == ["1", "3"]
    assert [text.value for text in one.at("y")] == []


@pytest.mark.parametrize(
    ("text", "number"), [("<x>1.5</x><x>2</x>", 1.5), ("<x>1,5</x>", None), ("<x/>", None)]
)
def test_a_number_at_a_path(text: str, number: float | None) -> None:
    (one,) = sdf(plugin("P", text)).plugins
    had = one.number("x")
    assert (had.value if had is not None else None) == number


def test_mimics() -> None:
    both = "<axis><mimic joint='a'/></axis><axis2><mimic joint='b'/></axis2>"
    (joint,) = sdf(f'<joint name="j" type="universal">{both}</joint>').joints
    assert [name.value for name in joint.mimics] == ["a", "b"]
    (joint,) = urdf('<joint name="j" type="revolute"><mimic joint="a"/></joint>').joints
    assert [name.value for name in joint.mimics] == ["a"]


@pytest.mark.parametrize(
    ("text", "acts"), [("", True), ("0", False), ("false", False), ("1", True)]
)
def test_gravity(text: str, acts: bool) -> None:
    inside = f"<gravity>{text}</gravity>" if text else ""
    (link,) = sdf(f'<link name="a">{inside}</link>').links
    assert (link.gravity.value, link.gravity.stated) == (acts, bool(text))


@pytest.mark.parametrize(
    ("said", "acts"),
    [
        ("", True),
        ("<turnGravityOff>true</turnGravityOff>", False),
        ("<turnGravityOff>false</turnGravityOff>", True),
        ("<gravity>0</gravity>", False),
    ],
)
def test_gravity_in_urdf(said: str, acts: bool) -> None:
    robot = urdf(f'<link name="a"/><link name="b"/><gazebo reference="b">{said}</gazebo>')
    assert [link.gravity.value for link in robot.links] == [True, acts]


def test_a_kinematic_link() -> None:
    robot = sdf('<link name="a"/><link name="b"><kinematic>1</kinematic></link>')
    assert [link.kinematic.value for link in robot.links] == [False, True]
