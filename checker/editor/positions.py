"""Positions as the protocol counts them: lines from 0, and code units of the client's encoding."""

from __future__ import annotations

from lsprotocol import types as lsp

from checker.base.record import Record
from checker.finding import Place
from checker.source.text import SourceText

_BYTES = {
    lsp.PositionEncodingKind.Utf8: ("utf-8", 1),
    lsp.PositionEncodingKind.Utf16: ("utf-16-le", 2),
    lsp.PositionEncodingKind.Utf32: ("utf-32-le", 4),
}
"""Codec of each encoding, and bytes of one of its code units."""


class Columns(Record):
    """Counts columns as the client does.

    Attributes:
        encoding: What client and server agreed on.
    """

    encoding: lsp.PositionEncodingKind = lsp.PositionEncodingKind.Utf16

    def position(self, source: SourceText, offset: int) -> lsp.Position:
        """Return the position of a character offset."""
        line, column = source.position(max(0, min(offset, len(source.text))))
        before = source.text[offset - column + 1 : offset]
        return lsp.Position(line - 1, self._units(before))

    def range(self, source: SourceText, start: int, end: int) -> lsp.Range:
        """Return the range of the characters from `start` up to, not including, `end`."""
        return lsp.Range(self.position(source, start), self.position(source, max(start, end)))

    def range_of(self, source: SourceText, place: Place) -> lsp.Range:
        """Return the range of a place; what is outside of the text is its nearest end."""
        start = _offset(source, place.line, place.column)
        end = _offset(source, place.end_line, place.end_column)
        return self.range(source, start, end)

    def offset(self, source: SourceText, position: lsp.Position) -> int:
        """Return the character offset of a position; behind a line's end, the end counts."""
        start = source.offset_of(position.line + 1, 1)
        if start is None:
            return len(source.text) if position.line > 0 else 0
        line = source.line(position.line + 1)
        if line.isascii():
            return start + min(position.character, len(line))
        codec, size = _BYTES[self.encoding]
        units = line.encode(codec, "surrogatepass")[: position.character * size]
        return start + len(units.decode(codec, "ignore"))

    def _units(self, text: str) -> int:
        if text.isascii():
            return len(text)
        codec, size = _BYTES[self.encoding]
        return len(text.encode(codec, "surrogatepass")) // size


def _offset(source: SourceText, line: int, column: int) -> int:
    offset = source.offset_of(line, column)
    if offset is not None:
        return offset
    start = source.offset_of(line, 1)
    return len(source.text) if start is None else start + len(source.line(line))
