"""The launch graph of a package: all that the commands of its spawner start, in one graph."""

from __future__ import annotations

import posixpath
from collections import ChainMap
from collections.abc import Mapping, Sequence
from itertools import chain
from types import MappingProxyType

from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchFaultKind, LaunchGraph, UnresolvedInclude
from checker.launch.ros1.launch_file import LaunchCommand, MissingLaunchFile, target_of
from checker.launch.spawner.emitted_xml import StartedXml
from checker.launch.spawner.reader import EXECUTABLES_ARGUMENTS
from checker.package.inheritance import Found
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.source.text import Span
from checker.source.xml import XmlDocument

USUAL_FILES = ("launch/description.launch", "launch/vehicle_topics.launch")
"""Launch files that a spawner usually starts; read with sample arguments if it does not."""

WITHOUT_ROBOT = frozenset({"gazebo_ros"})
"""Packages whose launch files start the simulator with a world, and nothing of a robot."""

SAMPLE_ARGUMENTS: Mapping[str, str] = MappingProxyType(
    dict(zip(("name", "world_name"), map(str, EXECUTABLES_ARGUMENTS), strict=True))
)
"""Arguments that a launcher passes to every launch file."""

_ABOVE = "../../"
"""What is above the folder of the packages is not available."""


def launch_graph(
    package: Package, started: StartedXml | NotAvailable
) -> LaunchGraph | NotAvailable:
    """Expand every launch file that a package's spawner starts, and those that it forgets."""
    if package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        return NotAvailable("the package needs no launch files", applicable=False)
    files = LaunchFiles(package)
    graphs = []
    commands: list[tuple[LaunchCommand, Span]] = []
    if isinstance(started, StartedXml):
        read = ((LaunchCommand.parse(e.text.value), e.text.span) for e in started.commands)
        commands = [(command, span) for command, span in read if command and command.file]
        graphs = [_started(command, span, files) for command, span in commands]
    named = {command.file for command, _ in commands}
    usual = [path for path in USUAL_FILES if posixpath.basename(path) not in named]
    graphs += _expanded(package, usual, files)
    if isinstance(started, NotAvailable):
        return (
            join_graphs(graphs, started.reason)
            if graphs
            else NotAvailable("no launch file can be read")
        )
    return join_graphs(graphs)


def _expanded(package: Package, paths: Sequence[str], files: LaunchFiles) -> list[LaunchGraph]:
    """Expand launch files with the arguments that a launcher gives."""
    parts = [package.part(path) for path in paths]
    documents = [package.xml(part.path) for part in parts if isinstance(part, Found)]
    return [
        expand_launch(document, SAMPLE_ARGUMENTS, files)
        for document in documents
        if isinstance(document, XmlDocument)
    ]


def _started(command: LaunchCommand, span: Span, files: LaunchFiles) -> LaunchGraph:
    """Expand the file that a command names; one that is not available is an unresolved include."""
    document = files.find(command.package, command.file)
    if isinstance(document, XmlDocument):
        # A command that forgets an argument (SPW013) must not hide what the file bridges.
        return expand_launch(document, {**SAMPLE_ARGUMENTS, **command.arguments}, files)
    missing = UnresolvedInclude(
        command.package, command.file, command.arguments, "/", str(document), span
    )
    return LaunchGraph(unresolved_includes=(missing,))


def join_graphs(graphs: Sequence[LaunchGraph], *reasons: str) -> LaunchGraph:
    """Return several graphs as one; `reasons` state what else is not known."""
    missing = (
        include
        for graph in graphs
        for include in graph.unresolved_includes
        if include.package not in WITHOUT_ROBOT
    )
    assumed = tuple(chain.from_iterable(graph.assumed_includes for graph in graphs))
    known = set(assumed)
    unread = (_reason(include) for include in missing if include not in known)
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
        assumed_includes=assumed,
        dormant_nodes=tuple(chain.from_iterable(graph.dormant_nodes for graph in graphs)),
        dormant_includes=tuple(chain.from_iterable(graph.dormant_includes for graph in graphs)),
        arguments=ChainMap({}, *(dict(graph.arguments) for graph in graphs)),
        undecided=tuple(chain.from_iterable(graph.undecided for graph in graphs)),
        faults=tuple(chain.from_iterable(graph.faults for graph in graphs)),
        unread=tuple(dict.fromkeys((*reasons, *unread))),
        unknown_commands="; ".join(reasons),
    )


def _reason(include: UnresolvedInclude) -> str:
    return f"{include.file} is not read: {include.reason}"


class LaunchFiles(Record):
    """Finds launch files, and the files they name, in the package and its siblings."""

    package: Package

    def __call__(self, package: str, path: str, from_file: str) -> XmlDocument | str:
        """Return an included file; see `ReadLaunch`."""
        del from_file  # all paths start at the package's folder
        if not package:
            return self._document(path)
        prefix = self._folder(package)
        if prefix is None:
            return f"package {package} is not available"
        return self._document(posixpath.join(prefix, path))

    def path_of(self, text: str) -> str | None:
        """Return the path of `$(find package)/path`; None if the package is not available."""
        package, path = target_of(text.strip())
        prefix = self._folder(package) if package else ""
        if prefix is None or not path:
            return None
        return posixpath.normpath(posixpath.join(prefix, path))

    def absent(self, text: str) -> str | None:
        """Return the path of `$(find package)/path` if the package is available and lacks it."""
        path = self.path_of(text)
        if path is None or path.startswith(_ABOVE) or self.package.exists(path):
            return None
        return path

    def find(self, package: str, file: str) -> XmlDocument | str:
        """Return the launch file of a command: roslaunch looks for it anywhere in the package."""
        prefix = self._folder(package)
        if prefix is None:
            return f"package {package} is not available"
        holder = self.package.named(package)
        files = holder.index.files if holder else ()
        named = (
            candidate.path for candidate in files if posixpath.basename(candidate.path) == file
        )
        path = next(named, f"launch/{file}")
        return self._document(posixpath.join(prefix, path))

    def _folder(self, name: str) -> str | None:
        """Return the way from the package to another one."""
        if name == self.package.name:
            return ""
        package = self.package.named(name)
        if package is None:
            return None
        return "" if package is self.package else f"../{package.name}"

    def _document(self, path: str) -> XmlDocument | str:
        document = self.package.xml(posixpath.normpath(path))
        if isinstance(document, XmlDocument):
            return document
        if self.package.exists(path):
            return f"{path} cannot be read"
        return MissingLaunchFile(f"{path} does not exist")


# The launch files of a package that has no spawner: each may be the one that a person starts.


MAX_FILES = 60
MAX_PARTS = 20_000
"""Nodes, parameters and includes of all launch files together."""


class LaunchEntry(Record, eq=False):
    """A launch file that no other one of the package starts, with its graph."""

    file: str
    graph: LaunchGraph


class LaunchEntries(Record, eq=False):
    """Launch files with which a package can be started.

    Attributes:
        entries: The entries in the order of their paths.
        unread: The reasons why launch files are left out.
    """

    entries: tuple[LaunchEntry, ...] = ()
    unread: tuple[str, ...] = ()

    @property
    def graph(self) -> LaunchGraph:
        """All of them as one."""
        return join_graphs([entry.graph for entry in self.entries], *self.unread)


def launch_entries(package: Package) -> LaunchEntries:
    """Expand the launch files of a package; those that others include count with these.

    A file that only a condition includes stays a separate one.
    """
    documents = _launch_files(package)
    unread = []
    if len(documents) > MAX_FILES:
        unread.append(f"only {MAX_FILES} of {len(documents)} launch files are read")
    graphs: dict[str, LaunchGraph] = {}
    files, parts = LaunchFiles(package), 0
    for document in documents[:MAX_FILES]:
        graph = expand_launch(document, {}, files)
        graphs[document.source.file] = graph
        parts += len(graph.nodes) + len(graph.params) + len(graph.includes)
        if parts > MAX_PARTS or any(f.kind is LaunchFaultKind.LIMIT for f in graph.faults):
            unread.append(f"{document.source.file} and the following files are too large to read")
            break
    included = {include.file for graph in graphs.values() for include in graph.includes}
    first = [file for file in graphs if file not in included] or list(graphs)
    return LaunchEntries(tuple(LaunchEntry(file, graphs[file]) for file in first), tuple(unread))


def _launch_files(package: Package) -> list[XmlDocument]:
    """Return `*.launch` anywhere, and the files of launch/ that contain a `<launch>`."""
    documents = []
    for entry in package.index.with_suffix(".launch", ".xml"):
        if not entry.path.endswith(".launch") and not entry.path.startswith("launch/"):
            continue
        if entry.is_of_tests:
            continue
        document = package.xml(entry.path)
        if isinstance(document, XmlDocument) and document.root.tag == "launch":
            documents.append(document)
    return documents
