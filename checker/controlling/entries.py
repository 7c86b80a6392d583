"""The launch files of a package that has no spawner: each may be the one that a person starts."""

from __future__ import annotations

from checker.launching import LaunchFiles, joined
from checker.model.launch.expand import expand_launch
from checker.model.launch.graph import LaunchFaultKind, LaunchGraph
from checker.package.package import Package
from checker.record import record
from checker.source.xml import XmlDocument

MAX_FILES = 60
MAX_PARTS = 20_000
"""Nodes, parameters and includes of all launch files together."""


@record(eq=False)
class LaunchEntry:
    """A launch file that no other one of the package starts, with what it starts."""

    file: str
    graph: LaunchGraph


@record(eq=False)
class LaunchEntries:
    """What a package can be started with.

    Attributes:
        entries: In the order of their paths.
        unread: Why launch files are left out.
    """

    entries: tuple[LaunchEntry, ...] = ()
    unread: tuple[str, ...] = ()

    @property
    def graph(self) -> LaunchGraph:
        """All of them as one."""
        return joined([entry.graph for entry in self.entries], *self.unread)


def launch_entries(package: Package) -> LaunchEntries:
    """Expand the launch files of a package; those that others include count with these.

    A file that only a condition includes stays one of its own.
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
    included = {each.file for graph in graphs.values() for each in graph.includes}
    first = [file for file in graphs if file not in included] or list(graphs)
    return LaunchEntries(tuple(LaunchEntry(file, graphs[file]) for file in first), tuple(unread))


def _launch_files(package: Package) -> list[XmlDocument]:
    """Return `*.launch` anywhere, and the files of launch/ that hold a `<launch>`."""
    found = []
    for entry in package.index.with_suffix(".launch", ".xml"):
        if not entry.path.endswith(".launch") and not entry.path.startswith("launch/"):
            continue
        document = package.xml(entry.path)
        if isinstance(document, XmlDocument) and document.root.tag == "launch":
            found.append(document)
    return found
