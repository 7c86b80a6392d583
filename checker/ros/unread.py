"""Possible starts in a launch file besides the nodes that are known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from checker.launch.ros2.graph import (
    CLASSIC_PACKAGE,
    Include,
    LaunchGraph,
    Process,
    display_path,
    share_path,
)
from checker.ros.servers import is_gazebo, is_gazebo_include
from checker.source.text import Located

_QUIET_COMMANDS = (
    *(("ros2", verb) for verb in ("action", "control", "lifecycle", "param", "service")),
    ("gz", "service"),
    ("ign", "service"),
)
"""Beginnings of commands that start no node and publish nothing."""
_QUIET_PROGRAMS = ("sleep", "source", ".", "echo", "cd", "export")


def unread_parts(graph: LaunchGraph) -> Iterator[str]:
    """Yield why a launch file may start more than its nodes and Gazebo; nothing if it does not."""
    if not all(map(_starts_no_node, graph.processes)):
        yield "a command may start further nodes"
    yield from unread_files(graph)


def unread_files(graph: LaunchGraph) -> Iterator[str]:
    """Yield why a launch file and what it includes are not read completely."""
    yield from (unread.reason for unread in graph.unread)
    yield from (fault.message for fault in graph.faults)
    for include in graph.includes:
        if include.is_unknown and not _is_of_gazebo(include):
            yield f"{display_path(include.target.value)} is not read"


def _is_of_gazebo(include: Include) -> bool:
    target = share_path(include.target.value)
    return is_gazebo_include(include) or (target is not None and target.package == CLASSIC_PACKAGE)


def _starts_no_node(process: Process) -> bool:
    return is_gazebo(process) or all(map(_is_quiet, process.commands))


def _is_quiet(command: Sequence[Located[str]]) -> bool:
    words = tuple(word.value for word in command[:2])
    return words in _QUIET_COMMANDS or (bool(words) and words[0] in _QUIET_PROGRAMS)
