"""Services and actions of a launch: which nodes offer them, and which wait for them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.base.record import Record
from checker.launch.ros2.graph import is_known
from checker.ros.wiring.nodes import WiredNode
from checker.source.text import Span

STATE = "get_state"
"""The service that returns the state of a lifecycle node."""
_LISTED = re.compile(r"\{(\w+)\}(.*)")


class Wanted(Record, eq=False):
    """A service or action that a node waits for.

    Attributes:
        name: Absolute.
        item: The item of a list that makes it wait; empty if its program always does.
        span: What states it, else the start of the node.
    """

    name: str
    item: str
    span: Span


def offered_services(node: WiredNode) -> Iterator[str]:
    """Yield the services and actions that a node may offer, those that are known."""
    names = node.facts.offers if node.facts is not None else ()
    yield from filter(None, map(node.resolve, names))
    if node.full_name:
        yield f"{node.full_name}/{STATE}"


def wanted_services(node: WiredNode) -> Iterator[Wanted]:
    """Yield the services and actions that a node waits for, those that are known."""
    if node.facts is None or not node.knows_parameters:
        return
    if any(name in node.settings for name in node.facts.unless):
        return
    for name in node.facts.waits_for:
        listed = _LISTED.fullmatch(name)
        setting = node.settings.get(listed[1]) if listed is not None else None
        if listed is None:
            yield from _wanted_service(node, name, "", node.node.span)
        elif setting is not None and isinstance(setting.value, list):
            for item in map(str, setting.value):
                yield from _wanted_service(node, f"{item}{listed[2]}", item, setting.span)


def _wanted_service(node: WiredNode, name: str, item: str, span: Span) -> Iterator[Wanted]:
    absolute = node.resolve(name) if is_known(name) else ""
    if absolute:
        yield Wanted(absolute, item, span)
