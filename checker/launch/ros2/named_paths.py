"""Files in share folders that launch files name, and whether they are there when it is launched."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros2.graph import (
    CLASSIC_PACKAGE,
    GAZEBO,
    Include,
    LaunchGraph,
    Parameter,
    ParameterFile,
    SharePath,
    Started,
    share_path,
)
from checker.package.installed import may_be_made, source_of
from checker.package.installed_from_outside import is_from_outside, may_be_from_outside
from checker.package.package import Package
from checker.source.text import Located, Span

_SUFFIX = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,9}\Z")
_SAVES = re.compile(
    r"(?:\A|[_.])(?:saved?|out(?:put|_file)|storage|record|write|dump|export)(?:[_.]|\Z)"
)
"""Names of parameters of what a node writes: `pcd_save.pcd_save_en`, `debug_out_file`."""
_OF_ROS = ("moveit_", "nav2_", "rviz")
_INSIDE = re.compile(r"/subt-check-packages/[\w./+-]{1,400}")
"""A path below `ROOT`."""


class NamedPath(Record, eq=False):
    """A file in a share folder that a launch file names.

    Attributes:
        path: The file.
        span: The place where it is named.
        needed: Whether what starts by default does not start, or not work, without it.
        include: Whether it is a launch file that is included.
    """

    path: SharePath
    span: Span
    needed: bool
    include: bool = False


def named_paths(graph: LaunchGraph) -> Iterator[NamedPath]:
    """Yield the files in share folders that a launch file names; what has no suffix is none."""
    for use in graph.files:
        yield from _paths(use.text.value, use.text.span, needed=use.certain)
    for include in filter(_may_start, graph.includes):
        needed = include.starts is True
        yield from _paths(include.target.value, include.target.span, needed=needed, include=True)
        if include.reason:
            yield from _handed_over(include)
    for node in filter(_may_start, graph.nodes):
        starts = node.starts is True
        shows = node.executable.value in ("rviz", "rviz2", "rqt_gui")
        yield from _in_words(node.arguments, needed=starts and not shows)
        saves = any(isinstance(it, Parameter) and _SAVES.search(it.name) for it in node.parameters)
        for parameter in node.parameters:
            yield from _in_parameter(parameter, needed=starts, saves=saves)
    for process in filter(_may_start, graph.processes):
        yield from _in_words(process.words, needed=_starts(process))


def _may_start(started: Started) -> bool:
    """Return whether no test that Python makes leaves an action out: `str(os.path.exists(x))`."""
    return not any(
        condition.written
        and condition.holds is False
        and condition.text.value not in condition.text.span.text
        for condition in started.conditions
    )


def _handed_over(include: Include) -> Iterator[NamedPath]:
    """Yield what a launch file is given that is not read; only Gazebo's certainly opens it."""
    target = share_path(include.target.value)
    opens = target is not None and target.package in (*GAZEBO, CLASSIC_PACKAGE)
    needed = opens and include.starts is True
    for value in include.arguments.values():
        for word in value.value.split():
            yield from _paths(word, value.span, needed=needed)


def _starts(started: Started) -> bool:
    return started.starts is True


def _in_words(words: Iterable[Located[str]], *, needed: bool) -> Iterator[NamedPath]:
    for word in words:
        yield from _paths(word.value, word.span, needed=needed)


def _in_parameter(
    parameter: Parameter | ParameterFile, *, needed: bool, saves: bool
) -> Iterator[NamedPath]:
    """Yield the file that a parameter names, if its name does not say that the node writes it.

    Args:
        parameter: A parameter of a node.
        needed: Whether the node starts by default.
        saves: Whether a parameter of the node is about saving, so that it may write the file.
    """
    if isinstance(parameter, ParameterFile):
        yield from _paths(parameter.path, parameter.span, needed=needed)
    elif isinstance(parameter.value, str) and not is_written(parameter.name):
        yield from _paths(parameter.value, parameter.span, needed=needed and not saves)


def _paths(text: str, span: Span, *, needed: bool, include: bool = False) -> Iterator[NamedPath]:
    """Yield the path that a text is, or the one that a command reads."""
    for opening in ("$(command ", "$(file-content "):
        if text.startswith(opening) and text.endswith(")"):
            for match in _INSIDE.finditer(text):
                behind = text[match.end() : match.end() + 1]
                if behind in (" ", ")"):
                    yield from _paths(match.group(), span, needed=needed)
            return
    path = share_path(text.strip())
    if path is not None and _SUFFIX.search(path.path):
        yield NamedPath(path, span, needed, include)


def is_written(name: str) -> bool:
    """Return whether the name of a parameter says that the node writes the file."""
    return _SAVES.search(name) is not None


def is_missing(package: Package, path: SharePath) -> bool:
    """Return whether an available package neither has nor makes such a file.

    Args:
        package: The package being checked.
        path: The file.
    """
    holder = package.named(path.package)
    if holder is None or not path.path or path.path.startswith(".."):
        return False
    there = holder.exists(path.path) or source_of(holder, path.path) is not None
    return not (there or may_be_made(holder, path.path) or is_from_outside(holder, path.path))


def without_slash(package: Package, path: SharePath) -> SharePath | None:
    """Return the path that is meant where parts are joined without a `/`; None for others.

    Launch joins the parts of a list as they are: `[share_of_arm, 'worlds/a.world']` is a path in
    `armworlds/`. The package is taken as meant if it has a file or folder of the joined name.

    Args:
        package: The package being checked.
        path: A path in a share folder.
    """
    if package.named(path.package) is not None:
        return None
    for holder in (package, *package.other_packages):
        rest = path.package.removeprefix(holder.declared_name)
        if rest != path.package and holder.exists(rest):
            return SharePath(holder.declared_name, f"{rest}/{path.path}" if path.path else rest)
    return None


def unavailable(package: Package, path: SharePath) -> str:
    """Return why a package cannot be read, and what helps; empty if that does not matter.

    Packages of ROS whose nodes are known contain no part of the robot.

    Args:
        package: The package being checked.
        path: The file of the other package.
    """
    name = path.package
    if name.startswith(_OF_ROS) or name in _known_packages() or package.named(name):
        return ""
    if package.is_loose and package.exists(f"../{name}/{path.path}"):
        return ""
    if package.workspace.ignores(name):
        return f"a file such as COLCON_IGNORE keeps package {name} from being built"
    if package.workspace.without_manifest(name):
        return f"the folder {name} has no package.xml, so it is no package"
    if package.exists(path.path):
        own = package.declared_name
        return (
            f"package {name} is not available, and {own} has the file: write {own} if it is meant"
        )
    return f"package {name} is not available; give its parent folder with --package-path DIR"


@cache
def _known_packages() -> frozenset[str]:
    """Return the packages of ROS whose nodes, or launch files, start no robot of the user's."""
    return frozenset((*GAZEBO, *(node.partition("/")[0] for node in table("ros_nodes")["nodes"])))


def may_be_installed(package: Package, path: SharePath) -> str:
    """Return why a build may install a file that is not found, as a clause; else nothing.

    A setup.py computes its `data_files`, and there is a file of that name; or CMakeLists.txt
    installs what is outside of the package.
    """
    holder = package.named(path.package)
    if holder is None:
        return ""
    if why := may_be_from_outside(holder, path.path):
        return why
    if holder.setup is None or holder.setup.complete:
        return ""
    name = posixpath.basename(path.path)
    is_there = any(posixpath.basename(file.path) == name for file in holder.index.files)
    return "data_files of setup.py is computed" if is_there else ""


def lies_elsewhere(package: Package, path: SharePath) -> str:
    """Return where a package has a file of that name, if it has just one; else nothing."""
    holder = package.named(path.package)
    name = posixpath.basename(path.path)
    files = holder.index.files if holder is not None else ()
    found = [file.path for file in files if posixpath.basename(file.path) == name]
    return found[0] if len(found) == 1 else ""
