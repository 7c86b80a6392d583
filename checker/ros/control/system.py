"""Control of the joints of a URDF package, from its launch files, YAML files and robots."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from checker.base.parts import NotAvailable
from checker.formats.urdf.description import UrdfDescription
from checker.launch.ros1.graph import LaunchGraph, Node, resolve_name
from checker.launch.ros1.package_launch import LaunchEntries, LaunchEntry, LaunchFiles
from checker.launch.ros1.substitution import is_known
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.package.containers import is_made_in_container
from checker.package.package import Package
from checker.ros.control.controllers import (
    ControlLaunch,
    ControlPlugin,
    ControlSystem,
    ParameterFault,
)
from checker.ros.control.controllers_reader import MANAGER_PLUGIN
from checker.ros.control.loaded_parameters import Parameters
from checker.ros.control.nodes import (
    Spawned,
    read_listener,
    read_model,
    read_spawned,
    read_state_publisher,
)
from checker.source.text import Located

_STATE_PLUGIN = "gazebo_ros_joint_state_publisher"
_MANAGER = "control"
"""Part of the names of plugins that run a controller manager, gazebo_ros_control or another."""
_PARAMETER = "robot_description"
_READING = ("command", "textfile")
_DESCRIPTION = re.compile(
    r"\$\(find\s{1,8}[\w.-]{1,200}\)/[^\s'\"$;|]{1,500}\.(?:urdf|xacro|sdf)\b"
)
_LONGEST = 5_000
"""Characters of a command that are read."""


def control_system(
    package: Package,
    entries: LaunchEntries,
    parameters: Parameters,
    robots: Sequence[Robot] | NotAvailable,
    descriptions: Sequence[UrdfDescription] | NotAvailable,
) -> ControlSystem | NotAvailable:
    """Put together what controls a URDF package's joints.

    Args:
        package: The package.
        entries: Its launch files.
        parameters: What they load from YAML.
        robots: Its robots.
        descriptions: Descriptions in its URDF files.
    """
    unread = list(entries.graph.unread)
    launches = [_launch(package, entry, unread) for entry in entries.entries]
    known = () if isinstance(robots, NotAvailable) else tuple(robots)
    described = () if isinstance(descriptions, NotAvailable) else tuple(descriptions)
    plugins = [plugin for robot in known for plugin in robot.plugins]
    system = ControlSystem(
        robots=tuple(robot.name for robot in known),
        joints={
            name: joint for robot in reversed(known) for name, joint in robot.joints_by_name.items()
        }
        if known
        else None,
        transmissions=tuple(
            transmission for one in described for transmission in one.transmissions
        ),
        plugins=tuple(_plugin(plugin) for plugin in _called(plugins, MANAGER_PLUGIN)),
        publishes_states=bool(_called(plugins, _STATE_PLUGIN)),
        has_manager=any(_MANAGER in library_stem(plugin.filename.value) for plugin in plugins),
        otherwise_moved=frozenset(_mentioned(plugins)),
        controllers=tuple(parameters.controllers),
        simulator_gains=tuple(parameters.gains),
        launches=tuple(launches),
        dormant=tuple(_dormant(entries)),
        faults=tuple(parameters.faults),
        file=described[0].file if described else "",
        unread_robot=_reason(robots) or _reason(descriptions),
        unread=tuple(dict.fromkeys((*unread, *parameters.unread))),
    )
    controls = (
        system.transmissions,
        system.plugins,
        system.controllers,
        system.spawned_controllers,
    )
    if not any((*controls, system.models)) and not system.unread_robot:
        return NotAvailable(
            "nothing in the package controls a robot or spawns one", applicable=False
        )
    return system


def _reason(part: object) -> str:
    return part.reason if isinstance(part, NotAvailable) else ""


def _called(plugins: Iterable[Plugin], stem: str) -> list[Plugin]:
    return [plugin for plugin in plugins if library_stem(plugin.filename.value) == stem]


def _mentioned(plugins: Iterable[Plugin]) -> Iterable[str]:
    """Yield the texts within plugins that may move joints by themselves."""
    for plugin in plugins:
        if library_stem(plugin.filename.value) != MANAGER_PLUGIN:
            yield from (descendant.text.value for descendant in plugin.element.descendants())


def _plugin(plugin: Plugin) -> ControlPlugin:
    stated = next(plugin.at("robotNamespace"), None)
    parameter = next(plugin.at("robotParam"), None)
    namespace = Located(resolve_name(stated.value, "/"), stated.span) if stated else None
    return ControlPlugin(plugin, namespace, parameter.value if parameter else _PARAMETER)


def _launch(package: Package, entry: LaunchEntry, unread: list[str]) -> ControlLaunch:
    graph = entry.graph
    listeners = (read_listener(node) for node in graph.nodes)
    models = (read_model(node) for node in graph.nodes)
    publishers = (read_state_publisher(node) for node in graph.nodes)
    unread += (
        f"whether {condition.value} is true is known only at launch"
        for condition in graph.undecided
    )
    return ControlLaunch(
        entry.file,
        tuple(_spawned(graph.nodes, unread)),
        tuple(listener for listener in listeners if listener and is_known(listener.topic)),
        tuple(model for model in models if model),
        tuple(publisher for publisher in publishers if publisher),
        frozenset(param.name for param in graph.params),
        tuple(missing_descriptions(package, graph)),
    )


def _spawned(nodes: Iterable[Node], unread: list[str]) -> Iterable[Spawned]:
    for node in nodes:
        for item in read_spawned(node):
            if isinstance(item, Spawned):
                yield item
            else:
                unread.append(item)


def _dormant(entries: LaunchEntries) -> Iterable[Spawned]:
    for entry in entries.entries:
        yield from _spawned(entry.graph.dormant_nodes, [])


def missing_descriptions(package: Package, graph: LaunchGraph) -> Iterable[ParameterFault]:
    """Yield the descriptions that a launch file reads and that no available package contains."""
    named = [(param.value, param.span) for param in graph.params if param.kind in _READING]
    named += [
        (word.value, word.span)
        for model in map(read_model, graph.nodes)
        if model is not None and (word := model.options.get("-file")) is not None
    ]
    files = LaunchFiles(package)
    for text, span in named:
        for match in _DESCRIPTION.finditer(text[:_LONGEST]):
            path = files.path_of(match.group())
            if path is None or package.exists(path) or is_made_in_container(package, path):
                continue
            yield ParameterFault(span, f"{path} is read as a description, but does not exist")


def missing_parameter_files(package: Package, graph: LaunchGraph) -> Iterable[ParameterFault]:
    """Yield the files of parameters that a launch file loads and an available package lacks."""
    files = LaunchFiles(package)
    for param in graph.params:
        path = files.absent(param.value) if param.kind == "load" else None
        if path is not None:
            message = f"{path} is loaded as parameters, but does not exist"
            yield ParameterFault(param.span, message)
