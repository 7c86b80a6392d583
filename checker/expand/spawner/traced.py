"""Text that remembers, piece by piece, which Ruby it came from."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from msgspec.structs import replace

from checker.base.record import Record
from checker.source.text import Span

NO_PARAMETERS: frozenset[str] = frozenset()


class Piece(Record):
    r"""A stretch of text with one origin.

    Attributes:
        text: The characters; never empty.
        span: The Ruby (or YAML) it came from; None for an argument not yet written anywhere.
        literal: The text stands in the source as it is, or as an escape such as `\n`;
            otherwise it was computed by the expression at `span`.
        parameters: Parameters of the called function, and globals, that influenced it.
    """

    text: str
    span: Span | None = None
    literal: bool = False
    parameters: frozenset[str] = NO_PARAMETERS

    @property
    def exact(self) -> bool:
        """Whether each character of the text is one character of the source."""
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

    def influenced(self, parameters: frozenset[str]) -> Piece:
        """Return the piece as also influenced by `parameters`."""
        if parameters <= self.parameters:
            return self
        return replace(self, parameters=self.parameters | parameters)

    def rooted(self, span: Span) -> Piece:
        """Return the piece with `span` as its origin, when it has none."""
        return replace(self, span=span) if self.span is None else self

    def computed_by(self, span: Span) -> Piece:
        """Return the piece with `span` as its origin, when a part of `span` computed it."""
        if self.span is None or (not self.literal and _holds(span, self.span)):
            return replace(self, span=span)
        return self


def _holds(outer: Span, inner: Span) -> bool:
    return outer.source is inner.source and outer.start <= inner.start and inner.end <= outer.end


class TracedString(Record, eq=False, dict=True):
    """Text made of pieces; it never changes."""

    pieces: tuple[Piece, ...] = ()

    @cached_property
    def text(self) -> str:
        """All characters."""
        return "".join([piece.text for piece in self.pieces])

    @cached_property
    def parameters(self) -> frozenset[str]:
        """What influenced any piece."""
        return NO_PARAMETERS.union(*(piece.parameters for piece in self.pieces))

    def cut(self, start: int, end: int) -> TracedString:
        """Return the part from `start` up to `end`."""
        if start <= 0 and end >= len(self.text):
            return self
        kept, at = [], 0
        for piece in self.pieces:
            if at >= end:
                break
            behind = at + len(piece.text)
            if behind > start and end > start:
                kept.append(piece.cut(start - at, end - at))
            at = behind
        return TracedString(tuple(kept))

    def cut_many(self, ranges: Iterable[tuple[int, int]]) -> list[TracedString]:
        """Return several parts, given in ascending order, in one pass."""
        found: list[TracedString] = []
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
            found.append(TracedString(tuple(kept) if end > start else ()))
        return found

    def influenced(self, parameters: frozenset[str]) -> TracedString:
        """Return the text as also influenced by `parameters`."""
        if not parameters:
            return self
        return TracedString(tuple(piece.influenced(parameters) for piece in self.pieces))

    def rooted(self, span: Span) -> TracedString:
        """Return the text with `span` as the origin of what has none."""
        return TracedString(tuple([piece.rooted(span) for piece in self.pieces]))

    def computed_by(self, span: Span) -> TracedString:
        """Return the text with `span` as the origin of what a part of `span` computed."""
        return TracedString(tuple([piece.computed_by(span) for piece in self.pieces]))


def joined(parts: Iterable[TracedString]) -> TracedString:
    """Return the texts one behind the other."""
    return TracedString(tuple(piece for part in parts for piece in part.pieces))


def computed(text: str, span: Span | None, parameters: frozenset[str]) -> TracedString:
    """Return a text that the expression at `span` computed."""
    return TracedString((Piece(text, span, False, parameters),) if text else ())
