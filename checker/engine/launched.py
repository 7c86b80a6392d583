"""The graphs of a package's launch files, for its report."""

from __future__ import annotations

from collections.abc import Iterable

from checker.engine.subject import Subject
from checker.report.launched import Launched, LaunchedNode, LaunchedTopic, LaunchedTransform
from checker.ros.wiring.wiring import Wiring
from checker.source.text import Span

MOST = 300
"""Nodes, topics and transforms of a launch that a report holds, each."""
_COMMON = ("/tf", "/tf_static", "/clock", "/diagnostics", "/parameter_events", "/rosout")
"""Topics that most nodes have, and no picture needs."""


def launched_files_of(subject: Subject) -> tuple[Launched, ...]:
    """Return the graph of each launch file of ROS 2 that starts a node, if a rule requested it."""
    return tuple(map(_launched, subject.cached_parts(Wiring)))


def _launched(wiring: Wiring) -> Launched:
    ends = [it for it in wiring.endpoints if it.certain and it.topic not in _COMMON]
    names = dict.fromkeys((*(node.label for node in wiring.nodes), *(it.by for it in ends)))
    topics: dict[str, tuple[str, ...]] = {}
    for end in ends:
        topics[end.topic] = tuple(dict.fromkeys((*topics.get(end.topic, ()), *end.types)))
    sides: dict[tuple[str, bool], dict[str, None]] = {}
    for end in ends:
        sides.setdefault((end.by, end.publishes), {})[end.topic] = None
    spans = [node.node.span for node in wiring.nodes]
    spans += [it.span for it in ends]
    spans += [it.span for it in wiring.transforms]
    unknown = next((it.publishes_more("*") for it in wiring.nodes if it.facts is None), "")
    return Launched(
        wiring.graph.file,
        _files(spans),
        tuple(
            LaunchedNode(
                name, *(tuple(sides.get((name, side), ()))[:MOST] for side in (True, False))
            )
            for name in [*names][:MOST]
        ),
        tuple(LaunchedTopic(name, types) for name, types in [*topics.items()][:MOST]),
        tuple(LaunchedTransform(it.parent, it.child, it.by) for it in wiring.transforms[:MOST]),
        next(iter((*wiring.unread, *filter(None, (unknown, wiring.unknown_parts)))), ""),
    )


def _files(spans: Iterable[Span]) -> tuple[str, ...]:
    return tuple(sorted({span.source.file for span in spans}))
