"""`MoveItConfigsBuilder`: the robot description that it makes; other parameters are not known."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from checker.formats.xacro.files import ROOT
from checker.launch.ros2.actions.node_parameters import MOVEIT
from checker.launch.ros2.graph import is_known
from checker.launch.ros2.python.call import Call
from checker.launch.ros2.values import FileText, Made, Unknown, Value, chosen_value
from checker.source.yaml import read_yaml

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter
    from checker.source.text import Span

_DESCRIPTIONS = ("robot_description", "robot_description_semantic")


def builder(call: Call) -> Value:
    """Return a builder."""
    parameters = ("robot_name", "robot_description", "package_name")
    values = dict(zip(parameters, call.arguments, strict=False)) | call.named
    robot = chosen_value(values.get("robot_name"))
    if not isinstance(robot, str) or not is_known(robot):
        return call.unknown("the robot name of MoveItConfigsBuilder is not known")
    package = chosen_value(values.get("package_name", f"{robot}_moveit_config"))
    if not isinstance(package, str) or not is_known(package):
        return call.unknown("the package of MoveItConfigsBuilder is not known")
    return Made("MoveItConfigs", {"robot": str(robot), "package": str(package)}, call.span)


def called(
    run: Interpreter,
    configs: Made,
    name: str,
    positional: list[Value],
    named: dict[str, Value],
) -> Value:
    """Return what a method of the builder returns: itself, or all parameters."""
    if name == "to_dict":
        return {**parameters(run, configs, "robot_description"), **_rest(configs)}
    if name in _DESCRIPTIONS:
        given = dict(zip(("file_path", "mappings"), positional, strict=False)) | named
        values = {**configs.values, name: given}
        return Made("MoveItConfigs", values, configs.span)
    return configs


def parameters(run: Interpreter, configs: Made, name: str) -> dict[str, Value]:
    """Return the value of an attribute of the built configurations, as parameters of a node."""
    given = configs.values.get(name)
    given = given if isinstance(given, dict) else {}
    file = chosen_value(given.get("file_path"))
    package, robot = configs.values["package"], configs.values["robot"]
    if isinstance(file, Unknown):
        return {name: file}
    if name == "robot_description":
        path, mappings = _description(run, package, robot, configs.span)
        if file is not None:
            path = posixpath.join(f"{ROOT}/{package}", str(file))
        elif run.world.exists(path) is False:
            return _rest(configs)  # MoveIt warns, and waits for the topic robot_description.
        mappings = chosen_value(given.get("mappings")) or mappings
        return {name: _command(path, mappings, configs)}
    if name == "robot_description_semantic" and file is not None:
        return {name: FileText.read(f"{ROOT}/{package}/{file}", configs.span)}
    return _rest(configs)


def _rest(configs: Made) -> dict[str, Value]:
    """Return what represents the parameters that the builder reads from its other files."""
    return {"moveit": Unknown(MOVEIT, configs.span)}


def _command(path: str, mappings: Value, configs: Made) -> Value:
    words: list[Value] = [f"xacro {path}"]
    if isinstance(mappings, dict):
        for name, value in mappings.items():
            words += [f" {name}:=", value]
    return Made("Command", {"command": words}, configs.span)


def _description(run: Interpreter, package: str, robot: str, span: Span) -> tuple[str, Value]:
    """Return the description that `.setup_assistant` names, else the usual one."""
    usual = f"{ROOT}/{package}/config/{robot}.urdf.xacro"
    source = run.world.read(f"{ROOT}/{package}/.setup_assistant", span)
    if isinstance(source, str):
        return usual, None
    root = read_yaml(source).root
    match root.plain() if root is not None else None:
        case {
            "moveit_setup_assistant_config": {
                "urdf": {"package": str(holder), "relative_path": str(path)}
            }
        } if holder:
            return f"{ROOT}/{holder}/{path}", None
    return usual, None
