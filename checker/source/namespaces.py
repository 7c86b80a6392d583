"""Prefixes: attribute names as written, and what only readers of namespaces refuse.

tinyxml2 (Gazebo) knows no namespaces; the readers of ROS (package.xml, launch, xacro) refuse a
prefix that nothing declares.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from lxml import etree

from checker.source.positions import XmlFault
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.source.xml import Element, XmlDocument

_XML = "http://www.w3.org/XML/1998/namespace"
_KNOWN = {"xacro": "http://www.ros.org/wiki/xacro"}
"""Namespaces of prefixes that robot files use."""

_REPORTED = 100


def attribute_keys(node: etree._Element, written: Iterable[str]) -> dict[str, str]:
    """Return lxml's key of each attribute, by its name as written.

    Args:
        node: The element.
        written: Names in the start tag; declarations of namespaces are passed over.
    """
    keys = {}
    for name in written:
        prefix, colon, local = name.partition(":")
        if prefix == "xmlns":
            continue
        uri = (_XML if prefix == "xml" else node.nsmap.get(prefix)) if colon else None
        keys[name] = f"{{{uri}}}{local}" if uri else name
    return keys


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
                f'add xmlns:{prefix}="{uri}" to the outermost element',
            )


def _names(element: Element) -> Iterator[tuple[str, Span]]:
    yield element.tag, element.name_span
    for name in element.attributes:
        yield name, element.attribute_name_span(name)


def _declared(element: Element, prefix: str) -> bool:
    return prefix in ("xml", "xmlns") or prefix in element.node.nsmap
