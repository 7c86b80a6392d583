"""Control of the joints of a URDF package, from its launch files, YAML files and robots."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.base.files import NotReadable
from checker.base.parts import NotAvailable
from checker.formats.urdf.description import UrdfDescription
from checker.launch.ros1.graph import LaunchGraph, Node, Param, resolve_name
from checker.launch.ros1.package_launch import LaunchEntries, LaunchEntry, LaunchFiles
from checker.launch.ros1.substitution import is_known
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.control.controllers import (
    ControlLaunch,
    Controller,
    ControlPlugin,
    ControlSystem,
    ParameterFault,
    SimulatorGains,
)
from checker.ros.control.controllers_reader import MANAGER_PLUGIN, read_controllers
from checker.ros.control.nodes import (
    Spawned,
    published_states,
    read_listener,
    read_model,
    read_spawned,
)
from checker.source.text import Excerpt, Located, SourceText, Span, text_excerpt

if TYPE_CHECKING:
    from checker.source.yaml import YamlDocument


# The parameters that launch files load from YAML: controllers and gains.


MAX_VALUES = 200_000
"""Values of all YAML texts together, as often as they are loaded."""
MAX_FILES = 200
"""YAML files of a package that are read though no launch file loads them."""


@dataclass(eq=False)
class Parameters:
    """Configurations in YAML texts; filled launch file by launch file.

    Attributes:
        package: The package whose files are read.
        controllers: The controllers in the order of the files.
        gains: The gains of `gazebo_ros_control` itself.
        faults: Files that are not there or cannot be read.
        unread: The reasons why parameters are not known.
    """

    package: Package
    controllers: list[Controller] = field(default_factory=list)
    gains: list[SimulatorGains] = field(default_factory=list)
    faults: list[ParameterFault] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)
    _seen: set[tuple[str, str, str, int]] = field(default_factory=set)
    _loaded: set[str] = field(default_factory=set)
    _documents: dict[str, YamlDocument] = field(default_factory=dict)
    _values: int = 0

    def load(self, graph: LaunchGraph) -> None:
        """Read what the launch files of a graph load."""
        files = LaunchFiles(self.package)
        for param in graph.params:
            if param.kind not in ("load", "yaml"):
                continue
            # One launch file may be followed from many others.
            key = (param.name, param.value, param.span.source.file, param.span.start)
            if key in self._seen:
                continue
            self._seen.add(key)
            self._load(param, files)

    def _load(self, param: Param, files: LaunchFiles) -> None:
        if not is_known(param.name):
            self.unread.append(f"namespace {param.name} is known only at launch")
        elif param.kind == "yaml" and param.text is not None:
            if param.text is not param.span:
                self._parse(text_excerpt(param.text), param.name, param.span)
        elif (path := files.path_of(param.value)) is None:
            self.unread.append(f"parameter file {param.value} is not available")
        else:
            self._load_file(path, param)

    def _load_file(self, path: str, param: Param) -> None:
        self._loaded.add(path)
        source = self.package.read(path)
        if isinstance(source, SourceText):
            self._parse(source, param.name, param.span)
        elif self.package.exists(path):
            self.unread.append(f"{path} {source.reason}")
        else:
            message = f"{path} is loaded as parameters, but does not exist"
            self.faults.append(ParameterFault(param.span, message))

    def _document(self, source: SourceText) -> YamlDocument:
        """Return a text as YAML; a file is parsed once, however often it is loaded."""
        # The library is loaded for those packages only that have such files.
        from checker.source.yaml import read_yaml

        if isinstance(source, Excerpt):
            return read_yaml(source)
        if source.file not in self._documents:
            self._documents[source.file] = read_yaml(source)
        return self._documents[source.file]

    def _parse(self, source: SourceText, namespace: str, loaded_by: Span | None) -> None:
        document = self._document(source)
        if loaded_by is not None:
            self.faults += (
                ParameterFault(
                    fault.span,
                    f"{source.file} cannot be read as YAML: {fault.message}",
                    hides=document.root is None,
                )
                for fault in document.faults
            )
        if document.root is None or not self._affordable(document.root.size, source.file):
            return
        for item in read_controllers(document.root, namespace, loaded_by):
            if isinstance(item, Controller):
                self.controllers.append(item)
            else:
                self.gains.append(item)

    def _affordable(self, values: int, file: str) -> bool:
        """Count values, and state whether there are not too many by now."""
        self._values += values
        if self._values > MAX_VALUES:
            self.unread.append(
                f"{file} is not read: the parameters have more than {MAX_VALUES} values"
            )
        return self._values <= MAX_VALUES

    def look_around(self) -> None:
        """Read the YAML files of the package that no launch file loads."""
        for path in self._left_over():
            source = self.package.read(path)
            if not isinstance(source, NotReadable):
                self._parse(source, "/", None)

    def _left_over(self) -> Iterator[str]:
        files = self.package.index.with_suffix(".yaml", ".yml")
        for file in files[:MAX_FILES]:
            if file.path not in self._loaded and not file.is_of_tests:
                yield file.path


_STATE_PLUGIN = "gazebo_ros_joint_state_publisher"
_MANAGER = "control"
"""Part of the names of plugins that run a controller manager, gazebo_ros_control or another."""
_PARAMETER = "robot_description"
_READING = ("command", "textfile")
_DESCRIPTION = re.compile(r"\$\(find\s{1,8}[\w-]{1,200}\)/[^\s'\"$;|]{1,500}\.(?:urdf|xacro|sdf)\b")
_LONGEST = 5_000
"""Characters of a command that are read."""


def control_system(
    package: Package,
    entries: LaunchEntries,
    robots: Sequence[Robot] | NotAvailable,
    descriptions: Sequence[UrdfDescription] | NotAvailable,
) -> ControlSystem | NotAvailable:
    """Put together what controls a URDF package's joints.

    Args:
        package: The package.
        entries: Its launch files.
        robots: Its robots.
        descriptions: Descriptions in its URDF files.
    """
    parameters, unread = Parameters(package), list(entries.graph.unread)
    launches = []
    for entry in entries.entries:
        parameters.load(entry.graph)
        launches.append(_launch(package, entry, unread))
    parameters.look_around()
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
    topics = (published_states(node) for node in graph.nodes)
    unread += (
        f"whether {condition.value} is true is known only at launch"
        for condition in graph.undecided
    )
    return ControlLaunch(
        entry.file,
        tuple(_spawned(graph.nodes, unread)),
        tuple(listener for listener in listeners if listener and is_known(listener.topic)),
        tuple(model for model in models if model),
        frozenset(topic for topic in topics if topic),
        frozenset(param.name for param in graph.params),
        tuple(_missing(package, graph)),
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


def _missing(package: Package, graph: LaunchGraph) -> Iterable[ParameterFault]:
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
            if path is not None and not package.exists(path):
                yield ParameterFault(span, f"{path} is read as a description, but does not exist")
