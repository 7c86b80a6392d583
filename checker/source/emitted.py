"""A text that a program or macro wrote, with places in the files that it came from."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from itertools import accumulate

from msgspec.structs import replace

from checker.base.record import Record
from checker.finding import Place
from checker.source.text import SourceText, Span


class Piece(Record):
    r"""A stretch of text with one origin.

    Attributes:
        text: The characters; never empty.
        span: What it came from; None for an argument that is not written anywhere yet.
        literal: The text is in the source as it is, or as an escape such as `\n`;
            otherwise it was computed by the expression at `span`.
    """

    text: str
    span: Span | None = None
    literal: bool = False

    @property
    def exact(self) -> bool:
        """True if each character of the text is one character of the source."""
        span = self.span
        return self.literal and span is not None and span.end - span.start == len(self.text)

    def cut(self, start: int, end: int) -> Piece:
        """Return the part from `start` up to `end`."""
        if start <= 0 and end >= len(self.text):
            return self
        start, end = max(start, 0), min(end, len(self.text))
        span = self.span
        if span is not None and self.exact:
            span = Span(span.source, span.start + start, span.start + end, span.holder)
        return replace(self, text=self.text[start:end], span=span)

    def with_origin(self, span: Span) -> Piece:
        """Return the piece with `span` as its origin, when it has none."""
        return replace(self, span=span) if self.span is None else self

    def computed_by(self, span: Span) -> Piece:
        """Return the piece with `span` as its origin, when a part of `span` computed it."""
        if self.span is None or (not self.literal and _holds(span, self.span)):
            return replace(self, span=span)
        return self


def _holds(outer: Span, inner: Span) -> bool:
    return outer.source is inner.source and outer.start <= inner.start and inner.end <= outer.end


class EmittedText(SourceText, dict=True, kw_only=True):
    """A text whose places are in the files that it came from.

    Offsets and lines (`line`, `position`) count in the emitted text; `place`, and with it every
    span, is in the Ruby, YAML or xacro file that it came from.

    Attributes:
        origin: What emitted it: a Ruby function, a xacro file.
        pieces: The text in pieces, each with its origin.
    """

    origin: Span
    pieces: tuple[Piece, ...]

    @cached_property
    def _starts(self) -> list[int]:
        return list(accumulate((len(piece.text) for piece in self.pieces), initial=0))[:-1]

    def _index(self, offset: int) -> int:
        """Return the number of the piece that contains a character; the last one at the end."""
        return max(0, bisect_right(self._starts, offset) - 1)

    def origin_of(self, start: int, end: int) -> Span:
        """Return where the characters from `start` up to `end` come from.

        A stretch of several pieces reaches from the first one's origin to the last one's, when
        both are in one file and in this order; otherwise it is the first one's.
        """
        if not self.pieces:
            return self.origin
        first, last = self._index(start), self._index(max(start, end - 1))
        origin = self._part(first, start, max(start, end))
        if first == last:
            return origin
        behind = self._part(last, start, end)
        if behind.source is origin.source and behind.start >= origin.end:
            return Span(origin.source, origin.start, behind.end)
        return origin

    def _part(self, index: int, start: int, end: int) -> Span:
        piece, at = self.pieces[index], self._starts[index]
        span = piece.span or self.origin
        if not piece.exact:
            return span
        last = span.start + min(end - at, len(piece.text))
        return Span(span.source, span.start + min(max(start - at, 0), len(piece.text)), last)

    def place(self, start: int, end: int) -> Place:
        """Return the place that the characters from `start` to `end` come from."""
        origin = self.origin_of(start, end)
        return origin.source.place(origin.start, origin.end)

    def pieces_in(self, start: int, end: int) -> range:
        """Return the numbers of the pieces that the characters from `start` up to `end` are in."""
        if not self.pieces or end <= start:
            return range(0)
        return range(self._index(start), self._index(end - 1) + 1)
