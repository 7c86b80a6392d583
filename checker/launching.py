"""The launch graph of a package: what the commands of its spawner start, joined into one."""

from __future__ import annotations

import posixpath
from collections import ChainMap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

from checker.model.launch.command import LaunchCommand
from checker.model.launch.expand import expand_launch
from checker.model.launch.graph import LaunchGraph, UnresolvedInclude
from checker.model.launch.include import MissingLaunchFile
from checker.package.inheritance import Found
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.parts import NotAtHand
from checker.source.text import Span
from checker.source.xml import XmlDocument
from checker.spawner.reader import EXECUTABLES_ARGUMENTS
from checker.spawning import SpawnedXml

USUAL_FILES = ("launch/description.launch", "launch/vehicle_topics.launch")
"""What a spawner starts; read with sample arguments when the spawner itself cannot be read."""


def launch_graph(package: Package, started: SpawnedXml | NotAtHand) -> LaunchGraph | NotAtHand:
    """Expand every launch file that a package's spawner starts."""
    if package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        return NotAtHand("the package needs no launch files", applicable=False)
    files = _LaunchFiles(package)
    if isinstance(started, NotAtHand):
        return _usual_graph(package, files)
    graphs = []
    for element in started.commands:
        command = LaunchCommand.parse(element.text.value)
        if command is not None and command.file:
            graphs.append(_started(command, element.text.span, files))
    return _joined(graphs)


def _usual_graph(package: Package, files: _LaunchFiles) -> LaunchGraph | NotAtHand:
    name, world = (str(each) for each in EXECUTABLES_ARGUMENTS)
    arguments = {"name": name, "world_name": world}
    graphs = []
    for path in USUAL_FILES:
        part = package.part(path)
        document = package.xml(part.path) if isinstance(part, Found) else None
        if isinstance(document, XmlDocument):
            graphs.append(expand_launch(document, arguments, files))
    return _joined(graphs) if graphs else NotAtHand("no launch file can be read")


def _started(command: LaunchCommand, span: Span, files: _LaunchFiles) -> LaunchGraph:
    """Expand the file that a command names; one that is not at hand is an unresolved include."""
    document = files.find(command.package, command.file)
    if isinstance(document, XmlDocument):
        return expand_launch(document, command.arguments, files)
    missing = UnresolvedInclude(
        command.package, command.file, command.arguments, "/", str(document), span
    )
    return LaunchGraph(unresolved_includes=(missing,))


def _joined(graphs: Sequence[LaunchGraph]) -> LaunchGraph:
    return LaunchGraph(
        nodes=tuple(chain.from_iterable(graph.nodes for graph in graphs)),
        bridges=tuple(chain.from_iterable(graph.bridges for graph in graphs)),
        dormant_bridges=tuple(chain.from_iterable(graph.dormant_bridges for graph in graphs)),
        params=tuple(chain.from_iterable(graph.params for graph in graphs)),
        environment=tuple(chain.from_iterable(graph.environment for graph in graphs)),
        includes=tuple(chain.from_iterable(graph.includes for graph in graphs)),
        unresolved_includes=tuple(
            chain.from_iterable(graph.unresolved_includes for graph in graphs)
        ),
        arguments=ChainMap({}, *(dict(graph.arguments) for graph in graphs)),
        undecided=tuple(chain.from_iterable(graph.undecided for graph in graphs)),
        faults=tuple(chain.from_iterable(graph.faults for graph in graphs)),
    )


@dataclass(frozen=True)
class _LaunchFiles:
    """Finds launch files in the package and its siblings."""

    package: Package

    def __call__(self, package: str, path: str, from_file: str) -> XmlDocument | str:
        """Return an included file; see `ReadLaunch`."""
        if not package:
            return self._read(posixpath.join(posixpath.dirname(from_file), path))
        prefix = self._folder(package)
        if prefix is None:
            return f"package {package} is not at hand"
        return self._read(posixpath.join(prefix, path))

    def find(self, package: str, file: str) -> XmlDocument | str:
        """Return the launch file of a command: roslaunch looks for it anywhere in the package."""
        prefix = self._folder(package)
        if prefix is None:
            return f"package {package} is not at hand"
        holder = self.package if not prefix else self.package.workspace.package(package)
        paths = [each.path for each in holder.index.with_suffix(file)] if holder else []
        path = next((p for p in paths if posixpath.basename(p) == file), f"launch/{file}")
        return self._read(posixpath.join(prefix, path))

    def _folder(self, name: str) -> str | None:
        """Return the way from the package to another one."""
        if name == self.package.name:
            return ""
        found = self.package.workspace.package(name)
        if found is None:
            return None
        return "" if found is self.package else f"../{found.name}"

    def _read(self, path: str) -> XmlDocument | str:
        document = self.package.xml(posixpath.normpath(path))
        if isinstance(document, XmlDocument):
            return document
        if self.package.exists(path):
            return f"{path} cannot be read"
        return MissingLaunchFile(f"{path} does not exist")
