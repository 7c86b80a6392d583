"""Prefixes: attribute names as written, and what only readers of namespaces refuse.

tinyxml2 (Gazebo) knows no namespaces; the readers of ROS (package.xml, launch, xacro) refuse a
prefix that nothing declares.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.source.positions import XmlFault
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.source.xml import Element, XmlDocument

_KNOWN = {"xacro": "http://www.ros.org/wiki/xacro"}
"""Namespaces of prefixes that robot files use."""

_REPORTED = 100


def namespace_faults(document: XmlDocument) -> Iterator[XmlFault]:
    """Yield the first use of each prefix that nothing declares; not of more than 100."""
    seen: set[str] = set()
    for element in document.elements:
        for name, span in _names(element):
            prefix, colon, _ = name.partition(":")
            if not (prefix and colon) or prefix in seen or _declared(element, prefix):
                continue
            seen.add(prefix)
            if len(seen) > _REPORTED:
                return
            uri = _KNOWN.get(prefix, "…")
            yield XmlFault(
                span,
                f"the prefix {prefix!r} is not declared",
                f'add xmlns:{prefix}="{uri}" to the root element',
            )


def _names(element: Element) -> Iterator[tuple[str, Span]]:
    yield element.tag, element.name_span
    for name in element.attributes:
        yield name, element.attribute_name_span(name)


def _declared(element: Element, prefix: str) -> bool:
    return prefix in ("xml", "xmlns") or prefix in element.node.nsmap
