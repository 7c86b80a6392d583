"""Start and end of each tag of an XML text, by expat.

expat (standard library) gives the byte of each event. The text is passed to it as UTF-8, and bytes
are turned back into characters where the text is not plain ASCII.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import accumulate
from types import MappingProxyType
from typing import TYPE_CHECKING
from xml.parsers import expat

from checker.base.record import Record
from checker.finding import Edit
from checker.source.text import SourceText, Span
from checker.source.xml_errors import (
    explain,
    is_lenient,
    mend_angles,
    mend_characters,
    mend_comments,
    mend_declaration,
    mend_roots,
)
from checker.source.xml_positions import LocatedTags, TagPosition, XmlFault

if TYPE_CHECKING:
    from checker.source.xml import Element, XmlDocument


# Prefixes: attribute names as written, and what only readers of namespaces refuse.
#
# tinyxml2 (Gazebo) knows no namespaces; the readers of ROS (package.xml, launch, xacro) refuse a
# prefix that nothing declares.


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
                _declaring(document.root, prefix) if prefix in _KNOWN else None,
            )


def _declaring(root: Element, prefix: str) -> Edit:
    """Return the edit that declares a prefix behind the attributes of the root element."""
    end = root.position.start + len(root.span.text.rstrip("/>").rstrip())
    return Span(root.source, end, end).replacement(f' xmlns:{prefix}="{_KNOWN[prefix]}"')


def _names(element: Element) -> Iterator[tuple[str, Span]]:
    yield element.tag, element.name_span
    for name in element.attributes:
        yield name, element.attribute_name_span(name)


def _declared(element: Element, prefix: str) -> bool:
    return prefix in ("xml", "xmlns") or prefix in element.node.nsmap


# The parts of one start tag: its name and its attributes.


_ATTRIBUTE = re.compile(r"""([^\s=<>/"']+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_NAME = re.compile(r"<\s*([^\s/>]+)")

Range = tuple[int, int]


class AttributeSpans(Record):
    """Character ranges of a start tag's name and of each attribute's name and value."""

    tag: Range
    attributes: dict[str, tuple[Range, Range]]


def scan_start_tag(text: str, start: int, end: int) -> AttributeSpans:
    """Find the name and the attributes in the start tag `text[start:end]`."""
    name = _NAME.match(text, start, end)
    tag = name.span(1) if name else (start, end)
    attributes = {}
    for match in _ATTRIBUTE.finditer(text, tag[1], end):
        value = match.span(2) if match.group(2) is not None else match.span(3)
        attributes[match.group(1)] = (match.span(1), value)
    return AttributeSpans(tag, attributes)


def locate_tags(source: SourceText, max_depth: int) -> LocatedTags | XmlFault:
    """Find every tag, or the first fault.

    What tinyxml2 forgives, and Gazebo therefore loads, is blanked out (offsets stay the same) and
    reported as tolerated.
    """
    text, tolerated = mend_declaration(source)
    result = _TagReader(source, text, max_depth).run()
    if isinstance(result, XmlFault):
        text, faults = mend_comments(source, text)
        tolerated += faults
        result = _TagReader(source, text, max_depth).run() if faults else result
    if isinstance(result, XmlFault) and is_lenient(source):
        text, faults = mend_characters(source, text)
        text, angles = mend_angles(source, text)
        faults += angles
        tolerated += faults
        result = _TagReader(source, text, max_depth).run() if faults else result
        if isinstance(result, XmlFault):
            text, faults = mend_roots(text, result)
            tolerated += faults
            result = _TagReader(source, text, max_depth).run() if faults else result
    return result if isinstance(result, XmlFault) else LocatedTags(text, result, tuple(tolerated))


class _Refused(Exception):
    """Raised inside a handler to stop the parser; carries the fault."""

    def __init__(self, fault: XmlFault) -> None:
        super().__init__(fault.message)
        self.fault = fault


_NONE: Mapping[str, str] = MappingProxyType({})
"""One for all elements without attributes: a text may have millions."""


def _without_namespaces(attributes: Mapping[str, str]) -> Mapping[str, str]:
    """Return attributes without the declarations of namespaces."""
    return {name: value for name, value in attributes.items() if name.split(":")[0] != "xmlns"}


class _TagReader:
    """Runs expat over one text and notes the byte of each event."""

    def __init__(self, source: SourceText, text: str, max_depth: int) -> None:
        self.source = source
        self.text = text
        self.max_depth = max_depth
        self.data = text.encode("utf-8")
        self.to_chars = _byte_to_char(self.data)
        self.tags: list[TagPosition] = []
        self.open_tags: list[TagPosition] = []
        self.parser = expat.ParserCreate(encoding="utf-8")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._doctype

    def run(self) -> list[TagPosition] | XmlFault:
        """Return the tags, or the first fault."""
        try:
            self.parser.Parse(self.data, True)
        except _Refused as refused:
            return refused.fault
        except expat.ExpatError as error:
            still_open = [self.to_chars(tag.start) for tag in self.open_tags]
            at = self.to_chars(self.parser.ErrorByteIndex)
            return explain(self.source, expat.ErrorString(error.code), at, still_open)
        finally:
            # It holds this reader's methods: only the garbage collection would part the two.
            del self.parser
        _finish(self.data, self.tags, self.to_chars)
        return self.tags

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        own = _without_namespaces(attributes) if attributes else _NONE
        tag = TagPosition(name, own, self.parser.CurrentByteIndex, -1, -1, -1)
        self.open_tags.append(tag)
        self.tags.append(tag)
        if len(self.open_tags) > self.max_depth:
            message = f"elements are nested more than {self.max_depth} levels deep"
            hint = "look for a missing end tag or a generator that never closes its elements"
            self._refuse(message, hint)

    def _end(self, _name: str) -> None:
        self.open_tags.pop().end_start = self.parser.CurrentByteIndex

    def _doctype(self, *_: object) -> None:
        hint = "remove it; robot files do not need one"
        self._refuse("a document type (<!DOCTYPE>) is not allowed", hint)

    def _refuse(self, message: str, hint: str) -> None:
        # expat is already inside a document type when it reports it.
        at = self.text.rfind("<", 0, self.to_chars(self.parser.CurrentByteIndex) + 1)
        end = self.text.find(">", at) + 1 or at
        raise _Refused(XmlFault(Span(self.source, at, end), message, hint))


def _finish(data: bytes, tags: list[TagPosition], to_chars: Callable[[int], int]) -> None:
    """Find where each tag closes and turn byte offsets into character offsets.

    expat's end event points behind an empty tag `<b/>` and at the `<` of `</c>`.
    """
    for tag in tags:
        start_end = _tag_end(data, tag.start)
        if data[start_end - 2 : start_end] == b"/>":
            tag.end_start = end = start_end
        else:
            end = data.find(b">", tag.end_start) + 1
        tag.start = to_chars(tag.start)
        tag.start_end = to_chars(start_end)
        tag.end_start = to_chars(tag.end_start)
        tag.end = to_chars(end)


_UP_TO_ITS_END = re.compile(rb"""[^>"']*+(?:(?:"[^"]*+"|'[^']*+')[^>"']*+)*+>""")
"""Possessive: else the engine remembers 200 bytes for each attribute, and there may be millions."""


def _tag_end(data: bytes, start: int) -> int:
    """Return the offset behind the `>` that closes a start tag, skipping quoted values."""
    match = _UP_TO_ITS_END.match(data, start)
    return match.end() if match else len(data)


_BLOCK = 512
_INSIDE_CHARACTER = bytes(range(0x80, 0xC0))
"""Bytes of UTF-8 that begin no character."""


def _byte_to_char(data: bytes) -> Callable[[int], int]:
    """Return the map from offsets in UTF-8 to offsets in the text, by counts for each block."""
    if data.isascii():
        return lambda index: index

    def characters(start: int, end: int) -> int:
        return len(data[start:end].translate(None, _INSIDE_CHARACTER))

    blocks = (characters(start, start + _BLOCK) for start in range(0, len(data), _BLOCK))
    before = list(accumulate(blocks, initial=0))

    def to_chars(index: int) -> int:
        block = index // _BLOCK
        return before[block] + characters(block * _BLOCK, index)

    return to_chars
