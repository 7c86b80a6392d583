"""The parts of one start tag: its name and its attributes."""

from __future__ import annotations

import re

from checker.record import record

_ATTRIBUTE = re.compile(r"""([^\s=<>/"']+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_NAME = re.compile(r"<\s*([^\s/>]+)")

Range = tuple[int, int]


@record()
class AttributeSpans:
    """Character ranges of a start tag's name and of each attribute's name and value."""

    tag: Range
    attributes: dict[str, tuple[Range, Range]]


def scan_start_tag(text: str, start: int, end: int) -> AttributeSpans:
    """Find the name and the attributes in the start tag `text[start:end]`."""
    name = _NAME.match(text, start, end)
    tag = name.span(1) if name else (start, end)
    attributes = {}
    for found in _ATTRIBUTE.finditer(text, tag[1], end):
        value = found.span(2) if found.group(2) is not None else found.span(3)
        attributes[found.group(1)] = (found.span(1), value)
    return AttributeSpans(tag, attributes)
