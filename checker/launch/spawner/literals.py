"""Text with the Ruby that it came from, and Ruby's string literals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cached_property

from checker.base.record import Record
from checker.launch.spawner.signals import Unreadable
from checker.source.emitted import Piece
from checker.source.ruby import RubyNode
from checker.source.text import SourceText, Span


class TracedString(Record, eq=False, dict=True):
    """Text made of pieces; it never changes."""

    pieces: tuple[Piece, ...] = ()

    @cached_property
    def text(self) -> str:
        """All characters."""
        return "".join([piece.text for piece in self.pieces])

    def cut(self, start: int, end: int) -> TracedString:
        """Return the part from `start` up to `end`."""
        return self.cut_many([(start, end)])[0]

    def cut_many(self, ranges: Iterable[tuple[int, int]]) -> list[TracedString]:
        """Return several parts, given in ascending order, in one pass."""
        parts: list[TracedString] = []
        index = at = 0
        for start, end in ranges:
            while index < len(self.pieces) and at + len(self.pieces[index].text) <= start:
                at += len(self.pieces[index].text)
                index += 1
            kept, here, place = [], index, at
            while here < len(self.pieces) and place < end:
                kept.append(self.pieces[here].cut(start - place, end - place))
                place += len(self.pieces[here].text)
                here += 1
            parts.append(TracedString(tuple(kept) if end > start else ()))
        return parts

    def with_origin(self, span: Span) -> TracedString:
        """Return the text with `span` as the origin of what has none."""
        return TracedString(tuple([piece.with_origin(span) for piece in self.pieces]))

    def computed_by(self, span: Span) -> TracedString:
        """Return the text with `span` as the origin of what a part of `span` computed."""
        return TracedString(tuple([piece.computed_by(span) for piece in self.pieces]))


def join_strings(parts: Iterable[TracedString]) -> TracedString:
    """Return the texts one behind the other."""
    return TracedString(tuple(piece for part in parts for piece in part.pieces))


def computed_string(text: str, span: Span | None) -> TracedString:
    """Return a text that the expression at `span` computed."""
    return TracedString((Piece(text, span),) if text else ())


# Ruby's string literals: escapes, and the lines of heredocs without their indentation.


Range = tuple[int, int]

DOUBLE_QUOTED = re.compile(r"\r\n|\\(?:\r\n|.)", re.DOTALL)
"""Sequences with a special meaning in a literal in which escapes count."""
RAW = re.compile(r"\r\n")
"""The same in a literal without any escapes, such as a heredoc of `<<'XML'`."""
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "s": " ", "\n": "", "\r\n": ""}
_NOT_READ = frozenset("abefuvxcCM01234567")
"""Escapes that make control characters, or that characters' numbers follow."""
_INDENT = re.compile(r"[ \t]*")
_TAB = 8
"""Ruby counts a tab up to the next multiple of 8 columns."""


def single_quoted(quotes: str) -> re.Pattern[str]:
    """Return the same for single quotes: only they and the backslash can be escaped."""
    return re.compile(rf"\r\n|\\[\\{re.escape(quotes)}]")


def decode_literal(
    source: SourceText, ranges: Iterable[Range], escapes: re.Pattern[str]
) -> TracedString:
    """Read stretches of a literal.

    Raises:
        Unreadable: An escape of a character's number, or of a control character.
    """
    pieces = [
        Piece(text, Span(source, start, end), True)
        for first, last in ranges
        for text, start, end in _stretches(source, first, last, escapes)
        if text
    ]
    return TracedString(tuple(pieces))


def _stretches(
    source: SourceText, start: int, end: int, pattern: re.Pattern[str]
) -> Iterator[tuple[str, int, int]]:
    """Yield plain stretches and escapes, each with its range in the source."""
    at = start
    for match in pattern.finditer(source.text, start, end):
        yield source.text[at : match.start()], at, match.start()
        yield _unescaped(source, match), match.start(), match.end()
        at = match.end()
    yield source.text[at:end], at, end


def _unescaped(source: SourceText, match: re.Match[str]) -> str:
    whole = match.group()
    if whole == "\r\n":
        return "\n"
    body = whole[1:]
    if body in _NOT_READ:
        span = Span(source, match.start(), match.end())
        raise Unreadable(span, f"uses the escape {whole}, which is not supported")
    return _ESCAPES.get(body, body)


def heredoc_parts(opening: RubyNode) -> list[list[Range] | RubyNode] | None:
    """Return the stretches of a heredoc's body, and the interpolations between them.

    Args:
        opening: The opening, such as `<<~XML`.

    Returns:
        None if its end was not found.
    """
    body = opening.heredoc
    if body is None or not body.children or body.broken:
        return None
    text = body.source.text
    start = text.find("\n", body.start) + 1
    end = text.rfind("\n", 0, body.children[-1].start) + 1
    raw = "'" in opening.text
    holes = [] if raw else [node for node in body.children if node.type == "interpolation"]
    stretches: list[Range] = []
    for hole in holes:
        stretches.append((start, hole.start))
        start = hole.end
    stretches.append((start, end))
    dedent = opening.text.startswith("<<~")
    kept = _dedented(text, stretches) if dedent else [[stretch] for stretch in stretches]
    parts: list[list[Range] | RubyNode] = [kept[0]]
    for hole, ranges in zip(holes, kept[1:], strict=True):
        parts += [hole, ranges]
    return parts


def _dedented(text: str, stretches: list[Range]) -> list[list[Range]]:
    """Cut each stretch into lines without the indentation that all lines share."""
    last = len(stretches) - 1
    lines = [
        _lines(text, start, end, begins=index == 0, hole=index < last)
        for index, (start, end) in enumerate(stretches)
    ]
    widths = [
        _width(text, start, indent_end)
        for stretch in lines
        for start, indent_end, end, begins in stretch
        if begins and not _blank(text, indent_end, end, end == stretches[-1][1])
    ]
    common = min(widths, default=0)
    return [
        [
            (_cut(text, start, indent_end, common) if begins else start, end)
            for start, indent_end, end, begins in stretch
        ]
        for stretch in lines
    ]


def _lines(
    text: str, start: int, end: int, *, begins: bool, hole: bool
) -> list[tuple[int, int, int, bool]]:
    """Return each line as its start, the end of its indentation, its end, and if it begins here.

    The first line of a stretch behind `#{}` continues a line; a `#{}` in the first column
    (`hole`) is a separate line without indentation.
    """
    lines = []
    while start < end:
        line_end = text.find("\n", start, end) + 1 or end
        indent = _INDENT.match(text, start, line_end)
        lines.append((start, indent.end() if indent else start, line_end, begins))
        start, begins = line_end, text[line_end - 1] == "\n"
    if hole and begins:
        lines.append((end, end, end, True))
    return lines


def _blank(text: str, indent_end: int, end: int, last: bool) -> bool:
    """Return whether a line is blank; `#{}` after the indentation is not blank."""
    rest = text[indent_end:end]
    return rest in {"\n", "\r\n"} or (rest == "" and last)


def _width(text: str, start: int, end: int) -> int:
    width = 0
    for char in text[start:end]:
        width = width // _TAB * _TAB + _TAB if char == "\t" else width + 1
    return width


def _cut(text: str, start: int, end: int, common: int) -> int:
    """Return the start of the line without `common` columns of indentation."""
    width = 0
    while start < end and width < common:
        after = width // _TAB * _TAB + _TAB if text[start] == "\t" else width + 1
        if after > common:
            break
        width, start = after, start + 1
    return start
