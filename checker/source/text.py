"""A file's text, and the map from offsets to lines and columns."""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property
from typing import ClassVar, Generic, Protocol, TypeVar

from msgspec.structs import replace

from checker.base.record import Record
from checker.finding import SNIPPET_LIMIT, Edit, Place

# The characters between two tags that are no text: comments, instructions, CDATA brackets.


_OPENING = re.compile(r"<!--|<\?|<!\[CDATA\[")
_CLOSING = {"<!--": "-->", "<?": "?>", "<![CDATA[": "]]>"}


def blank_markup(text: str) -> str:
    """Return a text of the same length with blanks for what is no text.

    Args:
        text: What is between two tags of a well-formed document.
    """
    if "<" not in text:
        return text
    parts: list[str] = []
    at = 0
    while opening := _OPENING.search(text, at):
        closing = _CLOSING[opening.group()]
        inside_end = text.find(closing, opening.end())
        inside_end = len(text) if inside_end < 0 else inside_end
        inside = text[opening.end() : inside_end]
        parts += [text[at : opening.start()], " " * len(opening.group())]
        parts.append(inside if closing == "]]>" else " " * len(inside))
        parts.append(" " * len(closing))
        at = inside_end + len(closing)
    return "".join([*parts, text[at:]])[: len(text)]


_LINE_COMMENT = re.compile(r"^[ \t]*#.*$", re.MULTILINE)


def without_comments(file: str, text: str) -> str:
    """Return a text of the same length with blanks for comments.

    Args:
        file: The path: in Python and YAML, comments are whole lines; other files are XML.
        text: The text of the file.
    """
    if file.lower().endswith((".py", ".yaml", ".yml")):
        return _LINE_COMMENT.sub(lambda match: " " * len(match.group()), text)
    return blank_markup(text)


T = TypeVar("T")


class SourceText(Record, eq=False, dict=True):
    """The decoded text of one file.

    Attributes:
        file: Path relative to the package folder (see `Place.file`).
        text: The text, line endings as in the file.
        encoding: The encoding of the file on disk.
        wrapper: Tag of an element that the checker put around the text; empty for none.
    """

    wrapper: ClassVar[str] = ""

    file: str
    text: str
    encoding: str = "utf-8"

    @cached_property
    def _line_starts(self) -> list[int]:
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Return the line and column, both from 1, of a character offset."""
        line = bisect_right(self._line_starts, offset)
        return line, offset - self._line_starts[line - 1] + 1

    def where(self, offset: int) -> str:
        """Return `FILE:LINE` of a character offset."""
        return f"{self.file}:{self.position(offset)[0]}"

    def offset_of(self, line: int, column: int) -> int | None:
        """Return the character offset of a line and column, both from 1; None outside the text."""
        starts = self._line_starts
        if not 1 <= line <= len(starts) or column < 1:
            return None
        end = starts[line] if line < len(starts) else len(self.text) + 1
        offset = starts[line - 1] + column - 1
        return offset if offset < end else None

    def stretch_of(self, edit: Edit) -> tuple[int, int] | None:
        """Return the offsets that an edit replaces; None if its text does not stand there."""
        place = edit.place
        start = self.offset_of(place.line, place.column)
        end = self.offset_of(place.end_line, place.end_column)
        if start is None or end is None or self.text[start:end] != edit.original:
            return None
        return start, end

    def line(self, number: int) -> str:
        """Return the text of a line (from 1) without its line ending."""
        starts = self._line_starts
        end = starts[number] if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r\n")

    def place(self, start: int, end: int) -> Place:
        """Return the place of the characters from `start` up to, not including, `end`."""
        line, column = self.position(start)
        end_line, end_column = self.position(max(start, end))
        snippet = self.line(line)[:SNIPPET_LIMIT]
        return Place(self.file, line, column, end_line, end_column, snippet=snippet)

    def whole(self) -> Span:
        """Return a span of no characters at the top of the file: the file as a whole."""
        return Span(self, 0, 0)


class HasPath(Protocol):
    """An XML element."""

    @property
    def path(self) -> str:
        """Path by tags and names."""
        ...


class Span(Record, eq=False):
    """A stretch of a source: from `start` up to, not including, `end`.

    Attributes:
        holder: The XML element that it belongs to.
    """

    source: SourceText
    start: int
    end: int
    holder: HasPath | None = None

    @property
    def element(self) -> str:
        """Path of the XML element, else empty; few places are ever shown, so it is found late."""
        return self.holder.path if self.holder is not None else ""

    @property
    def span(self) -> Span:
        """Return itself, so that a span can stand wherever something with a span is expected."""
        return self

    @property
    def text(self) -> str:
        """The marked characters."""
        return self.source.text[self.start : self.end]

    @property
    def line(self) -> int:
        """First line, in the file that a person would open."""
        return self.place().line

    def replacement(self, text: str) -> Edit:
        """Return the edit that replaces the text by another."""
        return Edit(self.place(), text, self.text)

    def place(self, note: str = "") -> Place:
        """Return the place in the file that a person would open."""
        place = self.source.place(self.start, self.end)
        return replace(place, element=self.element, note=note)


class Located(Record, Generic[T]):
    """A value and the place it was read from.

    Attributes:
        value: The value.
        span: Its text; when `stated` is false, the element that could have stated it.
        stated: False if the value is a default that the file does not spell out.
    """

    value: T
    span: Span
    stated: bool = True


# A stretch of a file read as a text of its own, with the places of the file.


class Excerpt(SourceText, kw_only=True):
    """A text inside another one; places are those of the outer text.

    Attributes:
        outer: The whole text.
        offset: Characters in front of the excerpt.
    """

    outer: SourceText
    offset: int

    def place(self, start: int, end: int) -> Place:
        """Return the place in the outer text."""
        return self.outer.place(start + self.offset, end + self.offset)


def text_excerpt(span: Span) -> Excerpt:
    """Return the text of an XML element, the indentation of its first line included.

    Args:
        span: The span of the whole text.
    """
    source, start = span.source, span.start
    text = source.text
    line_start = text.rfind("\n", 0, start) + 1
    if not text[line_start:start].strip(" "):
        start = line_start
    return Excerpt(source.file, blank_markup(text[start : span.end]), outer=source, offset=start)
