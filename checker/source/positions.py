"""Where each tag of an XML text begins and ends, by expat.

expat (standard library) gives the byte of each event. The text is handed to it as UTF-8, and
bytes are turned back into characters where the text is not plain ASCII.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import accumulate
from xml.parsers import expat

from checker.source.text import SourceText, Span


@dataclass(slots=True)
class TagPosition:
    """Character offsets of one element.

    Attributes:
        start: Of the start tag's `<`.
        start_end: Behind the start tag's `>`.
        end_start: Of the end tag's `<`; equal to `start_end` for `<a/>`.
        end: Behind the end tag's `>`.
    """

    start: int
    start_end: int
    end_start: int
    end: int


@dataclass(frozen=True, eq=False)
class XmlFault:
    """Why and where a text is not well-formed XML."""

    span: Span
    message: str
    hint: str = ""


@dataclass(frozen=True)
class LocatedTags:
    """All tags of a text in document order, and the text as the parsers are to read it."""

    text: str
    tags: list[TagPosition]
    tolerated: tuple[XmlFault, ...]


class _Refused(Exception):
    """Raised inside a handler to stop the parser."""


def locate_tags(source: SourceText, max_depth: int) -> LocatedTags | XmlFault:
    """Find every tag, or the first fault.

    What tinyxml2 forgives, and hence Gazebo loads, is blanked out (offsets stay the same) and
    reported as tolerated: blanks before the XML declaration, `--` inside a comment.
    """
    tolerated: list[XmlFault] = []
    text = source.text
    blanks = len(text) - len(text.lstrip())
    if blanks and text.startswith("<?xml", blanks):
        tolerated.append(
            XmlFault(
                Span(source, blanks, text.find("?>", blanks) + 2),
                "the XML declaration is not at the very start of the file",
                "remove the blank line in front of it",
            )
        )
        end = text.find("?>", blanks) + 2
        text = " " * end + text[end:] if end > 1 else text
    result = _run(source, text, max_depth)
    if isinstance(result, XmlFault):
        mended, faults = _mend_comments(source, text)
        if faults:
            second = _run(source, mended, max_depth)
            if not isinstance(second, XmlFault):
                return LocatedTags(mended, second, (*tolerated, *faults))
        return result
    return LocatedTags(text, result, tuple(tolerated))


_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)


def _mend_comments(source: SourceText, text: str) -> tuple[str, list[XmlFault]]:
    """Blank out `--` inside comments."""
    faults = []
    parts = list(text)
    for comment in _COMMENT.finditer(text):
        for dashes in re.finditer(r"-{2,}|-$", comment.group(1)):
            start = comment.start(1) + dashes.start()
            end = comment.start(1) + dashes.end()
            parts[start:end] = " " * (end - start)
            faults.append(
                XmlFault(
                    Span(source, start, end),
                    "'--' inside a comment",
                    "XML forbids two hyphens in a comment; write one",
                )
            )
    return "".join(parts), faults


def _run(source: SourceText, text: str, max_depth: int) -> list[TagPosition] | XmlFault:
    parser = expat.ParserCreate(encoding="utf-8")
    tags: list[TagPosition] = []
    open_tags: list[int] = []
    data = text.encode("utf-8")
    to_chars = _byte_to_char(text, data)
    refused: list[XmlFault] = []

    def refuse(message: str, hint: str) -> None:
        at = to_chars(parser.CurrentByteIndex)
        refused.append(
            XmlFault(Span(source, at, source.text.find(">", at) + 1 or at), message, hint)
        )
        raise _Refused

    def start(_name: str, _attributes: dict[str, str]) -> None:
        at = parser.CurrentByteIndex
        open_tags.append(len(tags))
        tags.append(TagPosition(at, -1, -1, -1))
        if len(open_tags) > max_depth:
            refuse(
                f"elements are nested deeper than {max_depth} levels",
                "look for a missing end tag or a generator that never closes its elements",
            )

    def end(_name: str) -> None:
        tag = tags[open_tags.pop()]
        at = parser.CurrentByteIndex
        tag.end_start = at

    def doctype(*_: object) -> None:
        refuse("a document type (<!DOCTYPE>) is not read", "remove it; robot files need none")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.StartDoctypeDeclHandler = doctype
    try:
        parser.Parse(data, True)
    except _Refused:
        return refused[0]
    except expat.ExpatError as error:
        return _explain(source, error, to_chars(parser.ErrorByteIndex), open_tags, tags, to_chars)
    _finish(data, tags, to_chars)
    return tags


def _finish(data: bytes, tags: list[TagPosition], to_chars: Callable[[int], int]) -> None:
    """Turn byte offsets into character offsets and find where each tag closes.

    expat's end event points behind an empty tag `<b/>` and at the `<` of `</c>`.
    """
    for tag in tags:
        start_end = _tag_end(data, tag.start)
        if data[tag.end_start : tag.end_start + 2] == b"</" and tag.end_start >= start_end:
            end = data.find(b">", tag.end_start) + 1
            if data[start_end - 2 : start_end] == b"/>":
                tag.end_start = end = start_end
        else:
            tag.end_start = end = start_end
        tag.start = to_chars(tag.start)
        tag.start_end = to_chars(start_end)
        tag.end_start = to_chars(tag.end_start)
        tag.end = to_chars(end)


_QUOTES_AND_END = re.compile(rb"""[>"']""")


def _tag_end(data: bytes, start: int) -> int:
    """Return the offset behind the `>` that closes a start tag, skipping quoted values."""
    at = start
    while found := _QUOTES_AND_END.search(data, at):
        quote = found.group()
        if quote == b">":
            return found.end()
        at = data.find(quote, found.end()) + 1
        if at == 0:
            break
    return len(data)


def _byte_to_char(text: str, data: bytes) -> Callable[[int], int]:
    if len(text) == len(data):
        return lambda index: index
    widths = (
        1 if c < "\x80" else 2 if c < "\u0800" else 3 if c < "\U00010000" else 4 for c in text
    )
    offsets = list(accumulate(widths, initial=0))
    table = {byte: char for char, byte in enumerate(offsets)}
    return lambda index: table.get(index, len(text))


_CLOSED_EARLY = re.compile(r"<[A-Za-z_][\w:.-]*>\s*\w+\s*=\s*[\"']")


def _explain(
    source: SourceText,
    error: expat.ExpatError,
    at: int,
    open_tags: list[int],
    tags: list[TagPosition],
    to_chars: Callable[[int], int],
) -> XmlFault:
    """Say in a person's words what expat stumbled over, and the likely cause."""
    message = expat.ErrorString(error.code)
    span = Span(source, at, min(at + 1, len(source.text)))
    if not source.text.strip():
        return XmlFault(source.whole(), "the file is empty")
    if message == "mismatched tag" and open_tags:
        opened = to_chars(tags[open_tags[-1]].start)
        name = re.match(r"</?([^\s>/]*)", source.text[opened:])
        closing = re.match(r"(?:</)?([^\s>/]*)", source.text[at:])
        opened_line = source.position(opened)[0]
        opened_name = name.group(1) if name else "?"
        closing_name = closing.group(1) if closing else "?"
        hint = f"<{opened_name}> of line {opened_line} is still open here"
        line = source.line(opened_line)
        lost = re.search(rf"(?<!<)/{re.escape(opened_name)}>", line)
        if lost:
            hint += f": write </{opened_name}> for {lost.group()}"
        return XmlFault(span, f"</{closing_name}> closes no open element", hint)
    if message == "no element found" and open_tags:
        opened_line = source.position(to_chars(tags[open_tags[-1]].start))[0]
        tag = re.match(r"<([^\s>/]*)", source.text[to_chars(tags[open_tags[-1]].start) :])
        label = tag.group(1) if tag else "?"
        return XmlFault(
            span, "the file ends too early", f"<{label}> of line {opened_line} is never closed"
        )
    early = _CLOSED_EARLY.search(source.text, max(0, at - 200), at + 200)
    hint = "an element is closed before its attributes" if early else ""
    return XmlFault(span, message, hint)
