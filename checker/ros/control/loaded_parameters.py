"""Parameters that launch files of ROS 1 load from YAML: controllers and gains."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.base.files import NotReadable
from checker.launch.ros1.graph import LaunchGraph, Param
from checker.launch.ros1.package_launch import LaunchEntries, LaunchFiles
from checker.launch.ros1.substitution import is_known
from checker.model import controllers as model
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.control.controllers import Controller, ParameterFault, SimulatorGains
from checker.ros.control.controllers_reader import read_controllers
from checker.ros.control.nodes import Spawned, read_spawned
from checker.source.text import Excerpt, SourceText, Span, text_excerpt

if TYPE_CHECKING:
    from checker.source.yaml import YamlDocument


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
        spawned: Full names of the controllers that launch files start.
    """

    package: Package
    controllers: list[Controller] = field(default_factory=list)
    gains: list[SimulatorGains] = field(default_factory=list)
    faults: list[ParameterFault] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)
    spawned: set[str] = field(default_factory=set)
    _seen: set[tuple[str, str, str, int]] = field(default_factory=set)
    _loaded: set[str] = field(default_factory=set)
    _documents: dict[str, YamlDocument] = field(default_factory=dict)
    _values: int = 0

    def load(self, graph: LaunchGraph) -> None:
        """Read what the launch files of a graph load."""
        files = LaunchFiles(self.package)
        read = (item for node in graph.nodes for item in read_spawned(node))
        self.spawned |= {item.full_name for item in read if isinstance(item, Spawned)}
        for param in graph.params:
            if param.kind not in ("load", "yaml"):
                continue
            # One launch file may be followed from many others.
            key = (param.name, param.value, param.span.source.file, param.span.start)
            if key in self._seen:
                continue
            self._seen.add(key)
            self._load(param, files)

    @property
    def reached(self) -> Iterator[Controller]:
        """Controllers without those that their spawner looks for in another namespace (CTL004)."""
        names = {posixpath.basename(name) for name in self.spawned}
        for it in self.controllers:
            if it.full_name in self.spawned or it.name not in names or self.unread:
                yield it

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


def loaded_parameters(package: Package, entries: LaunchEntries) -> Parameters:
    """Read what the launch files of a package load, then its other YAML files."""
    parameters = Parameters(package)
    for entry in entries.entries:
        parameters.load(entry.graph)
    parameters.look_around()
    return parameters


def controllers_for(
    robot: Robot, controllers: Iterable[Controller]
) -> tuple[model.Controller, ...]:
    """Return the controllers that name joints of a robot: those that launch files load, if any."""
    named = [
        it for it in controllers if any(name.value in robot.joints_by_name for name in it.joints)
    ]
    loaded = [it for it in named if it.loaded_by is not None]
    return tuple(
        model.Controller(
            it.name, it.type, it.parameters, frozenset(it.parameters), listed=False, span=it.span
        )
        for it in loaded or named
        if it.type is not None
    )
