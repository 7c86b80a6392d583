"""Topics that the source of a package publishes, as far as it states their names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from checker.package.package import Package
from checker.ros.wiring.nodes import WiredNode
from checker.source.text import SourceText

_SUFFIXES = (".cpp", ".cc", ".cxx", ".hpp", ".h", ".py")
_PUBLISHER = re.compile(
    r"\b(?:create_publisher|advertise)\s{0,8}"
    r"(?:<[^<>;\"]{1,200}>\s{0,8}\(|\(\s{0,80}[\w.]{1,200}\s{0,8},)"
    r"\s{0,80}[\"']([^\"'\s]{1,200})[\"']"
)
"""A publisher in C++, whose type is in angle brackets, or in Python, where it comes first."""


def source_topics(package: Package, nodes: Iterable[WiredNode]) -> frozenset[str]:
    """Return the topics that the packages of unknown programs may publish, absolute.

    Args:
        package: The package being checked.
        nodes: The nodes; one of a known program has none here.
    """
    written: dict[str, list[str]] = {}
    topics: set[str] = set()
    for node in nodes:
        if node.facts is None:
            name = node.node.package.value
            if name not in written:
                written[name] = [*_written(package.named(name))]
            topics.update(map(node.resolve, written[name]))
    return frozenset(topics)


def _written(holder: Package | None) -> Iterator[str]:
    """Yield the names of topics in the sources of a package, if it is available."""
    if holder is None:
        return
    for entry in holder.index.with_suffix(*_SUFFIXES):
        source = holder.read(entry.path)
        if isinstance(source, SourceText):
            yield from _PUBLISHER.findall(source.text)
