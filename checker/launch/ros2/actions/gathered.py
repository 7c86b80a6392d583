"""Results of a visit of launch actions, and the context that it needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from checker.base.record import Record
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import (
    Argument,
    EnvironmentChange,
    FileUse,
    Include,
    LaunchFault,
    Node,
    Process,
    Unread,
)
from checker.launch.ros2.values import PlacedText, Value


@dataclass(eq=False)
class Gathered:
    """Results so far; see `LaunchGraph`."""

    arguments: list[Argument] = field(default_factory=list)
    nodes: list[Node] = field(default_factory=list)
    processes: list[Process] = field(default_factory=list)
    includes: list[Include] = field(default_factory=list)
    environment: list[EnvironmentChange] = field(default_factory=list)
    files: list[FileUse] = field(default_factory=list)
    faults: list[LaunchFault] = field(default_factory=list)
    unread: list[Unread] = field(default_factory=list)


class FileRead(Record, eq=False):
    """Result of reading an included file; see `Include`."""

    path: str = ""
    accepts: frozenset[str] | None = None
    reason: str = ""


class Files(Protocol):
    """Follows includes, and calls functions that launch files leave for later."""

    def include(self, target: PlacedText, context: Context) -> FileRead:
        """Visit an included file."""

    def launch_file(self, package: str, name: str) -> str:
        """Return the path of the launch file of a package that has a name."""

    def call(self, function: Value, positional: Sequence[Value], context: Context) -> Value:
        """Return what a function of a launch file returns."""
