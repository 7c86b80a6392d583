"""The graph of a launch file, as reports show it."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from checker.base.record import Record


class LaunchedNode(Record):
    """A node, controller, plugin or bridge."""

    name: Annotated[str, Meta(description="Name in messages.")]
    publishes: Annotated[tuple[str, ...], Meta(description="Topics, absolute.")] = ()
    reads: Annotated[tuple[str, ...], Meta(description="Topics, absolute.")] = ()


class LaunchedTopic(Record):
    """A topic; several types where a parameter or the distribution decides."""

    name: str
    types: tuple[str, ...]


class LaunchedTransform(Record):
    """A transform and its publisher."""

    parent: str
    child: str
    by: str


class Launched(Record):
    """Nodes that a launch file starts with the defaults of its arguments, as far as known.

    Attributes:
        file: The launch file.
        files: All files that it is read from.
        nodes: The nodes, and everything else with topics.
        topics: The topics by name.
        transforms: Those of the robot's joints among them.
        unknown: The reason why there may be more; empty if all is known.
    """

    file: str
    files: tuple[str, ...]
    nodes: tuple[LaunchedNode, ...]
    topics: tuple[LaunchedTopic, ...]
    transforms: tuple[LaunchedTransform, ...]
    unknown: str = ""
