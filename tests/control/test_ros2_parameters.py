"""Parameter files of ROS 2: for which node a block is, and of which type a value."""

from __future__ import annotations

import pytest

from checker.model.controllers import ControllerFile, controllers_of
from checker.model.ros_parameters import NodeBlock, bare_managers, read_blocks
from checker.source.text import SourceText
from checker.source.yaml import YamlNode, read_yaml


def root(text: str, file: str = "c.yaml") -> YamlNode:
    document = read_yaml(SourceText(file, text))
    assert document.root is not None
    return document.root


def blocks(text: str) -> list[NodeBlock]:
    return list(read_blocks(root(text)))


@pytest.mark.parametrize(
    ("key", "namespace", "matches"),
    [
        ("controller_manager", "/", True),
        ("controller_manager", "/robot", False),
        ("/robot/controller_manager", "/robot", True),
        ("/robot/controller_manager", "/", False),
        ("/**/controller_manager", "/", True),
        ("/**/controller_manager", "/a/b", True),
        ("/*/controller_manager", "/a", True),
        ("/*/controller_manager", "/a/b", False),
        ("/**", "/a", True),
        ("/**/other", "/a", False),
    ],
)
def test_which_nodes_a_block_is_for(key: str, namespace: str, matches: bool) -> None:
    (block,) = blocks(f"{key}: {{ros__parameters: {{rate: 1}}}}")

    assert block.is_for("controller_manager", namespace) is matches


def test_namespaces_nest() -> None:
    (block,) = blocks("/**:\n  robot:\n    arm: {ros__parameters: {a: {b: 1}}}\n")

    assert (block.name, block.node) == ("/**/robot/arm", "arm")
    assert block.parameters["a.b"].number is not None


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ("10", "int"),
        ("10.", "double"),
        ("1e-3", "double"),
        (".nan", "double"),
        ("'10'", "string"),
        ("yes", "bool"),
        ("a b", "string"),
        ("[1, 2]", "int_array"),
        ("[1.0, 2.5]", "double_array"),
        ("[a, b]", "string_array"),
        ("[1, 2.5]", ""),
        ("[]", ""),
        ("$(var rate)", ""),
    ],
)
def test_types_are_those_that_ros_sees(value: str, kind: str) -> None:
    (block,) = blocks(f"node: {{ros__parameters: {{p: {value}}}}}")

    assert block.parameters["p"].type == kind


def test_a_controller_is_listed_by_the_manager_or_states_its_own_type() -> None:
    text = """
controller_manager:
  ros__parameters:
    update_rate: 50
    listed: {type: acme/Listed}
    dotted.type: acme/Dotted
own:
  ros__parameters: {type: acme/Own, joints: [a, b]}
/**:
  ros__parameters: {use_sim_time: true}
other_node:
  ros__parameters: {rate: 1}
"""
    file = ControllerFile("c.yaml", tuple(blocks(text)))
    controllers = {each.name: each for each in controllers_of([file])}

    assert {name: each.class_name for name, each in controllers.items()} == {
        "listed": "Listed",
        "dotted": "Dotted",
        "own": "Own",
    }
    assert controllers["listed"].block is None
    assert [text.value for text in controllers["own"].texts("joints")] == ["a", "b"]
    assert controllers["own"].own == {"type", "joints"}
    assert controllers["own"].flag("use_sim_time", default=False)


def test_a_file_with_another_type_of_a_controller_is_for_another_robot() -> None:
    text = "gripper:\n  ros__parameters: {{type: grippers/{}, {}: arm}}\n"
    files = [
        ControllerFile(file, tuple(read_blocks(root(text.format(kind, parameter), file))))
        for file, kind, parameter in (("a.yaml", "One", "joint"), ("b.yaml", "Two", "joints"))
    ]
    (gripper,) = controllers_of(files)

    assert gripper.class_name == "Two"
    assert gripper.own == {"type", "joints"}


def test_a_manager_without_the_level_of_parameters_is_told() -> None:
    spans = list(bare_managers(root("/**:\n  controller_manager:\n    update_rate: 50\n")))

    assert [span.line for span in spans] == [2]
    assert not list(bare_managers(root("controller_manager: {ros__parameters: {}}")))


def test_deep_files_end() -> None:
    text = "".join(f"{'  ' * level}a:\n" for level in range(40))

    assert not blocks(text + "  " * 40 + "ros__parameters: {p: 1}\n")
