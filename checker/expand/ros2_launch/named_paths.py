"""Files in share folders that launch files name, and whether they are there when it is launched."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator

from checker.base.record import Record
from checker.expand.ros2_launch.graph import (
    LaunchGraph,
    Parameter,
    ParameterFile,
    SharePath,
    Started,
    share_path,
)
from checker.expand.ros2_launch.package_files import holder_of, own_names
from checker.package.installed import source_of
from checker.package.package import Package
from checker.source.text import Located, SourceText, Span

_SUFFIX = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,9}\Z")
_WORD = re.compile(r"[\w-]+")
_INSIDE = re.compile(r"/subt-check-packages/[\w./+-]{1,400}")
"""A path below `ROOT`."""
_GAZEBO_ARGUMENTS = ("gz_args", "ign_args")
"""Arguments of `gz_sim.launch.py` that hold the words of a command."""
_GENERATES = re.compile(
    r"\b(?:add_custom_command|configure_file|xacro_\w{1,40}|file\s{0,8}\(\s{0,8}(?:GENERATE|DOWNLOAD)"
    r"|ExternalProject_Add|FetchContent_\w{1,40}|execute_process)\b",
    re.IGNORECASE,
)


class NamedPath(Record, eq=False):
    """A file in a share folder that a launch file names.

    Attributes:
        path: The file.
        span: Where it is named.
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
        yield from _named(use.text.value, use.text.span, needed=use.certain)
    for include in graph.includes:
        needed = include.starts is True
        yield from _named(include.target.value, include.target.span, needed=needed, include=True)
        for name, text in include.arguments.items():
            yield from _in_argument(name, text, needed=needed)
    for node in graph.nodes:
        starts = node.starts is True
        shows = node.executable.value in ("rviz", "rviz2", "rqt_gui")
        yield from _in_words(node.arguments, needed=starts and not shows)
        for parameter in node.parameters:
            yield from _in_parameter(parameter, needed=starts)
    for process in graph.processes:
        yield from _in_words(process.words, needed=_starts(process))


def _starts(started: Started) -> bool:
    return started.starts is True


def _in_argument(name: str, text: Located[str], *, needed: bool) -> Iterator[NamedPath]:
    """Yield the files that an included launch file is given; only Gazebo's world is known to be."""
    if name in _GAZEBO_ARGUMENTS:
        words = (Located(word, text.span) for word in text.value.split())
        yield from _in_words(words, needed=needed)
    else:
        yield from _named(text.value, text.span, needed=False)


def _in_words(words: Iterable[Located[str]], *, needed: bool) -> Iterator[NamedPath]:
    for word in words:
        yield from _named(word.value, word.span, needed=needed)


def _in_parameter(parameter: Parameter | ParameterFile, *, needed: bool) -> Iterator[NamedPath]:
    if isinstance(parameter, ParameterFile):
        yield from _named(parameter.path, parameter.span, needed=needed)
    elif isinstance(parameter.value, str):
        yield from _named(parameter.value, parameter.span, needed=needed)


def _named(text: str, span: Span, *, needed: bool, include: bool = False) -> Iterator[NamedPath]:
    """Yield the path that a text is, or the one that a command reads."""
    for opening in ("$(command ", "$(file-content "):
        if text.startswith(opening) and text.endswith(")"):
            for match in _INSIDE.finditer(text):
                behind = text[match.end() : match.end() + 1]
                if behind in (" ", ")"):
                    yield from _named(match.group(), span, needed=needed)
            return
    path = share_path(text.strip())
    if path is not None and _SUFFIX.search(path.path):
        yield NamedPath(path, span, needed, include)


def is_missing(package: Package, path: SharePath) -> bool:
    """Whether a package at hand has no such file, and does not make it either.

    Args:
        package: That is checked.
        path: The file.
    """
    holder = holder_of(package, path.package)
    if holder is None or not path.path or path.path.startswith(".."):
        return False
    there = holder.exists(path.path) or source_of(holder, path.path) is not None
    return not there and not _may_be_made(holder, path.path)


def lies_elsewhere(package: Package, path: SharePath) -> str:
    """Return where a package has a file of that name, if it has just one; else nothing."""
    holder = holder_of(package, path.package)
    name = posixpath.basename(path.path)
    files = holder.index.files if holder is not None else ()
    found = [file.path for file in files if posixpath.basename(file.path) == name]
    return found[0] if len(found) == 1 else ""


def is_left_out(package: Package, path: SharePath) -> bool:
    """Whether a package at hand has a file, and certainly does not install it there."""
    holder = holder_of(package, path.package)
    if holder is None or source_of(holder, path.path) is not None:
        return False
    return holder.exists(path.path) and tells_all(holder) and not _may_be_made(holder, path.path)


def tells_all(package: Package) -> bool:
    """Whether a package's CMakeLists.txt says in plain words all that is installed."""
    build = package.build
    if build is None or build.faults:
        return False
    others = re.compile(r"install|add_subdirectory|ament_auto_package|\binclude\b", re.IGNORECASE)
    for call in build.calls:
        if call.name == "install":
            words = [word.value for word in call.arguments]
            if call.conditional or any("${" in word for word in words):
                return False
        elif others.search(call.name) and call.name != "ament_python_install_package":
            return False
    return bool(package.installed)


def _may_be_made(holder: Package, path: str) -> bool:
    """Whether the build may make a file: it names it, or makes files whose names are not read."""
    stem = posixpath.basename(path).partition(".")[0]
    for file in ("CMakeLists.txt", "setup.py"):
        source = holder.read(file)
        if not isinstance(source, SourceText):
            continue
        if _GENERATES.search(source.text) or stem in _WORD.findall(source.text):
            return True
    return False


def is_whole_folder(package: Package, path: SharePath) -> bool:
    """Whether nothing of the top folder that a file of the checked package lies in is installed."""
    top = path.path.partition("/")[0]
    if path.package not in own_names(package):
        return False
    return not any(origin.partition("/")[0] == top for _, origin in package.installed)
