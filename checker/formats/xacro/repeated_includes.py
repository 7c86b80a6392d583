"""Files that xacro includes more than once: each time, all that they contain is there again."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from itertools import islice

from checker.formats.xacro.expanded import ExpandedDocument
from checker.formats.xacro.files import named_path
from checker.source.xml import Element, XmlDocument

_DEEPEST = 30
_STEPS = 2_000
"""Includes of one robot that are followed."""

Chain = tuple[Element, ...]
"""Includes, from that of the expanded file to the one that names a file."""


def repeated_include(document: XmlDocument, file: str) -> tuple[Element, Element] | None:
    """Return the two includes by which xacro reads a file twice; None if it is not so.

    Args:
        document: A document that xacro made.
        file: Path of the file as the package lists it.
    """
    if not isinstance(document, ExpandedDocument):
        return None
    documents = document.source.gathered.documents
    root = document.source.written.file
    start = next((path for path, it in documents.items() if it.source.file == root), "")
    chains = islice(_chains(documents, start, ()), _STEPS)
    found = [chain for path, chain in chains if documents[path].source.file == file][:2]
    # A file that is included once may be in one that is included twice.
    pairs = zip(*(reversed(chain) for chain in found), strict=False) if found[1:] else ()
    return next(((first, second) for first, second in pairs if first is not second), None)


def _chains(
    documents: Mapping[str, XmlDocument], path: str, around: Chain
) -> Iterator[tuple[str, Chain]]:
    """Yield each file that a file includes, also through others, with the includes."""
    if path not in documents or len(around) > _DEEPEST:
        return
    for element in documents[path].elements:
        if element.tag == "xacro:include":
            named = named_path(posixpath.dirname(path), element.get("filename") or "")
            if named in documents and named is not None and element not in around:
                yield named, (*around, element)
                yield from _chains(documents, named, (*around, element))
