"""The text that a spawner emits, with places in the Ruby that wrote it."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from itertools import accumulate

from checker.expand.spawner.literals import NO_PARAMETERS, Piece, TracedString
from checker.finding import Place
from checker.source.text import SourceText, Span


class EmittedText(SourceText, dict=True, kw_only=True):
    """A source whose places lie in the Ruby files that made it.

    Offsets, lines (`line`, `position`) count in the emitted text; `place` and therefore every span
    on it answer in the Ruby (or YAML) file.

    Attributes:
        origin: The Ruby function that emitted it.
        pieces: The text in pieces, each with its origin.
    """

    origin: Span
    pieces: tuple[Piece, ...]

    @classmethod
    def of(cls, traced: TracedString, origin: Span) -> EmittedText:
        """Make it of what the function at `origin` returned."""
        pieces = tuple(piece.rooted(origin) for piece in traced.pieces)
        return cls(origin.source.file, traced.text, origin=origin, pieces=pieces)

    @cached_property
    def _starts(self) -> list[int]:
        return list(accumulate((len(piece.text) for piece in self.pieces), initial=0))[:-1]

    def _index(self, offset: int) -> int:
        """Return the number of the piece that holds a character; the last one at the end."""
        return max(0, bisect_right(self._starts, offset) - 1)

    def origin_of(self, start: int, end: int) -> Span:
        """Return the Ruby that wrote the characters from `start` up to `end`.

        A stretch of several pieces reaches from the first one's origin to the last one's, when
        both lie in one file and in this order; otherwise it is the first one's.
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
        """Return the place in the Ruby file of the emitted characters from `start` to `end`."""
        origin = self.origin_of(start, end)
        return origin.source.place(origin.start, origin.end)

    def parameters_in(self, start: int, end: int) -> frozenset[str]:
        """Return the parameters and globals that influenced the characters.

        Args:
            start: Offset in the emitted text.
            end: Offset behind the last character.
        """
        if not self.pieces or end <= start:
            return NO_PARAMETERS
        pieces = self.pieces[self._index(start) : self._index(end - 1) + 1]
        return NO_PARAMETERS.union(*(piece.parameters for piece in pieces))
