"""Command lines of spawners and of spawn_model, and what a robot_state_publisher listens to."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchGraph, Node
from checker.ros.control.nodes import (
    Spawned,
    read_listener,
    read_model,
    read_spawned,
    read_state_publisher,
)
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml


def read_nothing(package: str, path: str, from_file: str) -> str:
    return f"{path} of {package or from_file} is not available"


def graph(content: str) -> LaunchGraph:
    document = parse_xml(SourceText("launch/main.launch", f"<launch>{content}</launch>"))
    assert isinstance(document, XmlDocument), document
    return expand_launch(document, {}, read_nothing)


def node(package: str, program: str, args: str = "", more: str = "") -> Node:
    found = graph(f'<node name="n" pkg="{package}" type="{program}" args="{args}" {more}/>').nodes
    return found[0]


def spawned(program: str, args: str, more: str = "") -> list[str]:
    read = read_spawned(node("controller_manager", program, args, more))
    return [each.full_name if isinstance(each, Spawned) else f"? {each}" for each in read]


@pytest.mark.parametrize(
    ("args", "more", "names"),
    [
        ("a b", "", ["/a", "/b"]),
        ("a b", 'ns="robot"', ["/robot/a", "/robot/b"]),
        ("--namespace robot a", "", ["/robot/a"]),
        ("--namespace=/robot a", 'ns="other"', ["/robot/a"]),
        ("--timeout 30 --stopped a --wait-for /clock", "", ["/a"]),
        ("a __log:=x b:=c", "", ["/a"]),
        ("left/a", 'ns="robot"', ["/robot/left/a"]),
        ("", "", []),
        ("--namespace", "", []),
    ],
)
def test_spawner(args: str, more: str, names: list[str]) -> None:
    assert spawned("spawner", args, more) == names


@pytest.mark.parametrize(
    ("args", "names"),
    [("spawn a b", ["/a", "/b"]), ("start a", ["/a"]), ("list", []), ("kill a", []), ("", [])],
)
def test_controller_manager(args: str, names: list[str]) -> None:
    assert spawned("controller_manager", args) == names


def test_unspawner_and_others_start_nothing() -> None:
    assert not spawned("unspawner", "a b")
    assert not list(read_spawned(node("other", "spawner", "a")))


@pytest.mark.parametrize("args", ["$(env CONTROLLERS)", "--namespace $(env R) a", "config/a.yaml"])
def test_what_the_launching_machine_knows_is_said(args: str) -> None:
    (said,) = spawned("spawner", args)
    assert said.startswith("? node n starts ")


def test_each_word_has_its_place() -> None:
    first, second = read_spawned(node("controller_manager", "spawner", "one  two"))
    assert isinstance(first, Spawned)
    assert isinstance(second, Spawned)
    assert (first.span.text, second.span.text) == ("one", "two")


_RSP = '<node name="s" pkg="robot_state_publisher" type="robot_state_publisher"'


@pytest.mark.parametrize(
    ("content", "topic"),
    [
        (f"{_RSP}/>", "/joint_states"),
        (f'{_RSP} ns="robot"/>', "/robot/joint_states"),
        (
            f'{_RSP}><remap from="joint_states" to="robot/joint_states"/></node>',
            "/robot/joint_states",
        ),
        (f'{_RSP}><remap from="/joint_states" to="/a/b"/></node>', "/a/b"),
        (f'{_RSP} ns="x"><remap from="/joint_states" to="/a/b"/></node>', "/x/joint_states"),
        (f'<remap from="joint_states" to="/a"/>{_RSP}/>', "/a"),
        (f'<group ns="g">{_RSP}/></group>', "/g/joint_states"),
    ],
)
def test_listener(content: str, topic: str) -> None:
    listener = read_listener(graph(content).nodes[0])
    assert listener is not None
    assert listener.topic == topic


def test_publishers_of_joint_states() -> None:
    gui = node("joint_state_publisher_gui", "joint_state_publisher_gui", "", 'ns="r"')
    relay = node("topic_tools", "relay", "/r/joint_states joint_states")
    found = [read_state_publisher(each) for each in (gui, relay, node("topic_tools", "relay"))]
    assert [it and (it.topic, it.is_source) for it in found] == [
        ("/r/joint_states", True),
        ("/joint_states", False),
        None,
    ]


def test_spawn_model() -> None:
    model = read_model(
        node(
            "gazebo_ros",
            "spawn_model",
            "-x 1 -z -0.5 -J hinge 0.3 -urdf -param robot_description -model arm "
            "-robot_namespace /r __name:=x stray",
            'ns="robots"',
        )
    )
    assert model is not None
    assert (model.model, model.namespace) == ("arm", "/r")
    assert model.parameter == "/robots/robot_description"
    assert "-urdf" in model.options
    assert [word.value for word in model.stray] == ["stray"]
    assert model.is_known


def test_a_package_name_with_a_dot_is_known() -> None:
    model = read_model(node("gazebo_ros", "spawn_model", "-file $(find crane.SLDASM)/a.urdf"))
    assert model is not None
    assert model.is_known


def test_spawn_model_takes_its_own_namespace() -> None:
    model = read_model(node("gazebo_ros", "spawn_model", "-file $(find p)/a.urdf", 'ns="r"'))
    assert model is not None
    assert model.namespace == "/r"
    assert model.is_known
    assert not model.parameter


def test_nodes_that_a_condition_leaves_out() -> None:
    found = graph('<node if="0" name="n" pkg="controller_manager" type="spawner" args="a"/>')
    assert not found.nodes
    (dormant,) = found.dormant_nodes
    assert [word.value for word in dormant.words] == ["a"]


@given(
    st.lists(st.sampled_from(["-model", "-J", "-param", "-urdf", "--namespace", "a", "b:=c", "="]))
)
def test_any_command_line_is_read(words: list[str]) -> None:
    args = " ".join(words)
    read_model(node("gazebo_ros", "spawn_model", args))
    list(read_spawned(node("controller_manager", "spawner", args)))
    list(read_spawned(node("controller_manager", "controller_manager", args)))
