"""Topics that the source of a package publishes, as far as it states their names."""

from __future__ import annotations

import re
from collections.abc import Iterator

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


def source_topics(package: Package, node: WiredNode) -> Iterator[str]:
    """Yield the topics that nodes of an unknown program's package may publish, absolute.

    Args:
        package: The package being checked.
        node: The node; one of a known program has none here.
    """
    holder = package.named(node.node.package.value) if node.facts is None else None
    if holder is None:
        return
    for entry in holder.index.with_suffix(*_SUFFIXES):
        source = holder.read(entry.path)
        if isinstance(source, SourceText):
            yield from map(node.resolve, _PUBLISHER.findall(source.text))
