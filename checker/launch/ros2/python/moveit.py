"""`MoveItConfigsBuilder`: the robot description that it makes; other parameters are not known."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from checker.formats.xacro.files import ROOT
from checker.launch.ros2.actions.node_parameters import MOVEIT
from checker.launch.ros2.graph import is_known
from checker.launch.ros2.python.call import Call
from checker.launch.ros2.values import (
    FilePath,
    FileText,
    Made,
    PlacedText,
    Unknown,
    Value,
    chosen_value,
)
from checker.source.yaml import read_yaml

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

_DESCRIPTIONS = ("robot_description", "robot_description_semantic")
_OTHERS = {
    "robot_description_kinematics": "config/kinematics.yaml",
    "joint_limits": "config/joint_limits.yaml",
}
"""Files that the builder always reads, by its methods: without one of them it stops."""


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
    built = "built" in configs.values
    if name in ("to_moveit_configs", "to_dict") and not built:
        _read_files(run, configs)
    if name == "to_moveit_configs":
        return Made(configs.name, {**configs.values, "built": True}, configs.span)
    if name == "to_dict":
        described = chosen_value(parameters(run, configs, "robot_description"))
        own = described if isinstance(described, dict) else {"robot_description": described}
        return {**own, **_rest(configs)}
    if name in (*_DESCRIPTIONS, *_OTHERS):
        given = dict(zip(("file_path", "mappings"), positional, strict=False)) | named
        configs.values[name] = given
    return configs


def parameters(run: Interpreter, configs: Made, name: str) -> Value:
    """Return the value of an attribute of the built configurations, as parameters of a node.

    It is always the same dictionary, since launch files put other values into it.
    """
    key = _built(name)
    if key not in configs.values:
        configs.values[key] = _made(run, configs, name)
        run.by_argument = True
    return configs.values[key]


def assign(configs: Made, name: str, value: Value) -> None:
    """Replace the value of an attribute of the built configurations."""
    configs.values[_built(name)] = value


def _built(name: str) -> str:
    """Return the key of an attribute; its name alone is that of a method of the builder."""
    return f"built {name}"


def _made(run: Interpreter, configs: Made, name: str) -> dict[str, Value]:
    if name not in _DESCRIPTIONS:
        return _rest(configs)
    path = _path(run, configs, name)
    if isinstance(path, Unknown):
        return {name: path}
    if name == "robot_description_semantic":
        return {name: FileText.read(path, configs.span)}
    given = _given(configs, name)
    if "file_path" not in given and run.world.exists(path) is False:
        return _rest(configs)  # MoveIt warns, and waits for the topic robot_description.
    return {name: _expanded(path, chosen_value(given.get("mappings")), configs)}


def _given(configs: Made, name: str) -> dict[Value, Value]:
    """Return what the launch file gives a method of the builder."""
    given = configs.values.get(name)
    return given if isinstance(given, dict) else {}


def _rest(configs: Made) -> dict[str, Value]:
    """Return what represents the parameters that the builder reads from its other files."""
    return {"moveit": Unknown(MOVEIT, configs.span)}


def _expanded(path: str, mappings: Value, configs: Made) -> Value:
    """Return the text of the description; where a mapping is a substitution, its command."""
    values = mappings if isinstance(mappings, dict) else {}
    words: list[Value] = [f"xacro {path}"]
    for name, value in values.items():
        words += [f" {name}:=", value]
    if all(isinstance(chosen_value(word), str) for word in words):
        return PlacedText(f"$(command {''.join(map(str, words))})", configs.span)
    command = Made("Command", {"command": words}, configs.span)
    return Made("ParameterValue", {"value": command, "value_type": "str"}, configs.span)


def _read_files(run: Interpreter, configs: Made) -> None:
    """Read the files without which the builder stops."""
    for name in ("robot_description_semantic", *_OTHERS):
        path = _path(run, configs, name)
        if isinstance(path, str):
            run.world.read(path, configs.span)


def _path(run: Interpreter, configs: Made, name: str) -> str | Unknown:
    """Return the file that the builder reads for a method: what is given, or the usual one."""
    folder = f"{ROOT}/{configs.values['package']}"
    file = chosen_value(_given(configs, name).get("file_path"))
    if file is None:
        return f"{folder}/{_OTHERS[name]}" if name in _OTHERS else _usual(run, configs, name)
    if isinstance(file, str | FilePath):
        return posixpath.join(folder, file.text if isinstance(file, FilePath) else str(file))
    return file if isinstance(file, Unknown) else Unknown("a path is no text", configs.span)


def _usual(run: Interpreter, configs: Made, name: str) -> str:
    """Return the file of a description if none is given.

    This is `config/ROBOT.urdf.xacro` or what `.setup_assistant` names, else `config/ROBOT.urdf`.
    """
    folder = f"{ROOT}/{configs.values['package']}"
    stem = f"{folder}/config/{configs.values['robot']}"
    kind = "srdf" if name == "robot_description_semantic" else "urdf"
    if kind == "urdf" and run.world.exists(f"{stem}.urdf.xacro"):
        return f"{stem}.urdf.xacro"
    source = run.world.read(f"{folder}/.setup_assistant", configs.span)
    root = read_yaml(source).root if not isinstance(source, str) else None
    match root.plain() if root is not None else None:
        case {"moveit_setup_assistant_config": dict(written)}:
            match written.get(kind, written.get(kind.upper())):
                case {"relative_path": str(path)} if kind == "srdf":
                    return f"{folder}/{path}"
                case {"package": str(holder), "relative_path": str(path)} if holder:
                    return f"{ROOT}/{holder}/{path}"
    return f"{stem}.{kind}"
