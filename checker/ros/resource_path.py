"""The path on which Gazebo searches meshes and models when a launch file starts it."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from checker.base.record import Record
from checker.launch.ros2.graph import (
    SHARE,
    EnvironmentChange,
    LaunchGraph,
    Unread,
    is_known,
    share_path,
)
from checker.launch.ros2.package_launch import launch_files
from checker.package.package import Package
from checker.package.resource_path import SearchedFolder, mentions, searched_folders, sets_path
from checker.source.text import Span

_PREFIX = re.compile(
    r"(?:/subt-check-packages-prefix/|\$\(find-pkg-prefix )[\w.-]{1,200}\)?/share(?:/|\Z)"
)
"""The folder of all share folders, below the prefix that a package is installed in."""

_SETS_NOTHING = ("ros_gz_sim", "ros_gz_bridge", "ros_ign_gazebo", "ros_ign_bridge", "gazebo_ros")
"""Packages whose launch files set variables for Gazebo alone, from package.xml."""


class ResourcePath(Record, eq=False):
    """The folders that Gazebo searches when a launch file starts it.

    Attributes:
        folders: What the available packages and the launch file put on the path.
        complete: Whether these are all folders that the available files name.
    """

    folders: tuple[SearchedFolder, ...]
    complete: bool

    @property
    def holds_packages(self) -> bool:
        """True if packages are found by their names, or may be."""
        return not self.complete or any(folder.folder == "" for folder in self.folders)

    def inside(self, name: str) -> SearchedFolder | None:
        """Return what puts a package's own folder on the path, instead of the one above it."""
        return next((folder for folder in self.folders if folder.folder == name), None)


def resource_path(package: Package, graph: LaunchGraph, *, classic: bool = False) -> ResourcePath:
    """Read what is on the path.

    Args:
        package: The package being checked.
        graph: The graph of the launch file that starts Gazebo.
        classic: Whether that is Gazebo Classic.
    """
    packages = (package, *package.other_packages)
    folders = [folder for each in packages for folder in searched_folders(each, classic=classic)]
    changes = [change for change in graph.environment if sets_path(change.name, classic=classic)]
    folders += (folder for change in changes for folder in _changed(change))
    complete = all(folder.known for folder in folders)
    elsewhere = any(
        _others_name_it(package, graph, changes, each, [*mentions(each, classic=classic)])
        for each in packages
    )
    return ResourcePath(tuple(folders), complete and not elsewhere and _is_read(graph))


def _is_read(graph: LaunchGraph) -> bool:
    """Return whether everything was read that may set a variable: a part of a node does not."""
    of_nodes = {_place(unread) for node in graph.nodes for unread in node.unread}
    if any(_place(unread) not in of_nodes for unread in graph.unread):
        return False
    beyond = [
        share_path(i.target.value) for i in graph.includes if i.reason and i.starts is not False
    ]
    return all(target is not None and target.package in _SETS_NOTHING for target in beyond)


def _place(unread: Unread) -> tuple[str, int, str]:
    return unread.span.source.file, unread.span.start, unread.reason


def _changed(change: EnvironmentChange) -> Iterator[SearchedFolder]:
    """Yield the folders that a launch file puts on the path."""
    text = _PREFIX.sub(f"{SHARE}/", change.value.value)
    if not is_known(text):
        yield SearchedFolder(None, False, change.span)
        return
    for path in filter(None, text.split(":")):
        folder = posixpath.normpath(path)
        below = folder == SHARE or folder.startswith(f"{SHARE}/")
        rest = folder.removeprefix(SHARE).lstrip("/") if below else None
        yield SearchedFolder(rest, True, change.span)


def _others_name_it(
    package: Package,
    graph: LaunchGraph,
    changes: list[EnvironmentChange],
    holder: Package,
    mentioned: list[Span],
) -> bool:
    """Return whether something else in a package names the path: users may set it.

    Launch files do, as far as their actions show. Other launch files of the checked package do not
    count, since none of them includes this one; those of another package may.
    """
    own = holder is package
    launched = {graph.file, *(include.path for include in graph.includes)}
    others = frozenset(launch_files(holder) if own else ())
    for mention in mentioned:
        file = mention.source.file if own else f"../{holder.name}/{mention.source.file}"
        if file in launched:
            changed = (c.span for c in changes if c.span.source.file == file)
            if not any(span.start <= mention.start < span.end for span in changed):
                return True
        elif mention.source.file not in others:
            return True
    return False
