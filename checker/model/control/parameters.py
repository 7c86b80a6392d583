"""The parameters that launch files load from YAML: controllers and gains."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.base.disk_file import NotReadable
from checker.expand.launch.graph import LaunchGraph, Param
from checker.expand.launch.package_launch import LaunchFiles
from checker.expand.launch.substitution import is_known
from checker.model.control.controllers import Controller, ParameterFault, SimulatorGains
from checker.model.control.controllers_reader import read_controllers
from checker.package.package import Package
from checker.source.text import Excerpt, SourceText, Span, text_excerpt

if TYPE_CHECKING:
    from checker.source.yaml import YamlDocument

MAX_VALUES = 200_000
"""Values of all YAML texts together, as often as they are loaded."""
MAX_FILES = 200
"""YAML files of a package that are looked at though no launch file loads them."""


@dataclass(eq=False)
class Parameters:
    """What YAML texts configure; filled launch file by launch file.

    Attributes:
        package: Whose files are read.
        controllers: In order of the files.
        gains: Of `gazebo_ros_control` itself.
        faults: Files that are not there or cannot be read.
        unread: Why parameters are not known.
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
            self.unread.append(f"namespace {param.name} is known at launch only")
        elif param.kind == "yaml" and param.text is not None:
            if param.text is not param.span:
                self._read(text_excerpt(param.text), param.name, param.span)
        elif (path := files.path_of(param.value)) is None:
            self.unread.append(f"parameter file {param.value} is not at hand")
        else:
            self._load_file(path, param)

    def _load_file(self, path: str, param: Param) -> None:
        self._loaded.add(path)
        source = self.package.read(path)
        if isinstance(source, SourceText):
            self._read(source, param.name, param.span)
        elif self.package.exists(path):
            self.unread.append(f"{path} {source.reason}")
        else:
            said = f"{path} is loaded as parameters and does not exist"
            self.faults.append(ParameterFault(param.span, said))

    def _document(self, source: SourceText) -> YamlDocument:
        """Return a text as YAML; a file is parsed once, however often it is loaded."""
        # The library is loaded for those packages only that have such files.
        from checker.source.yaml import read_yaml

        if isinstance(source, Excerpt):
            return read_yaml(source)
        if source.file not in self._documents:
            self._documents[source.file] = read_yaml(source)
        return self._documents[source.file]

    def _read(self, source: SourceText, namespace: str, loaded_by: Span | None) -> None:
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
        for found in read_controllers(document.root, namespace, loaded_by):
            if isinstance(found, Controller):
                self.controllers.append(found)
            else:
                self.gains.append(found)

    def _affordable(self, values: int, file: str) -> bool:
        """Count values, and say whether there are not too many by now."""
        self._values += values
        if self._values > MAX_VALUES:
            self.unread.append(f"{file} is not read: all parameters are over {MAX_VALUES} values")
        return self._values <= MAX_VALUES

    def look_around(self) -> None:
        """Read the YAML files of the package that no launch file loads."""
        for path in self._left_over():
            source = self.package.read(path)
            if not isinstance(source, NotReadable):
                self._read(source, "/", None)

    def _left_over(self) -> Iterator[str]:
        files = self.package.index.with_suffix(".yaml", ".yml")
        yield from (each.path for each in files[:MAX_FILES] if each.path not in self._loaded)
