"""Edits of one text: which of them go together, and what comes of them."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from checker.finding import Edit, Fix
from checker.source.text import SourceText


@dataclass(frozen=True, order=True)
class Stretch:
    """Characters `start` up to, not including, `end`, and what is to stand there."""

    start: int
    end: int
    replacement: str

    def collides(self, other: Stretch) -> bool:
        """Whether both cannot be replaced at once; two insertions at one point have no order."""
        if self.start == other.start:
            return True
        first, second = sorted((self, other))
        return second.start < first.end


@dataclass
class EditedText:
    """A text and the edits gathered for it.

    Attributes:
        stretches: In the order of the text; none collides with another.
    """

    source: SourceText
    stretches: list[Stretch] = field(default_factory=list)

    def stretch(self, edit: Edit) -> Stretch | None:
        """Return what an edit replaces; None where the text differs from what it expects."""
        offsets = self.source.stretch_of(edit)
        return None if offsets is None else Stretch(*offsets, edit.replacement)

    def accepts(self, stretch: Stretch) -> bool:
        """Whether a stretch is free; one that is to become the same text already is."""
        beside = self._beside(stretch)
        return stretch in beside or not any(map(stretch.collides, beside))

    def add(self, stretch: Stretch) -> None:
        """Take a stretch that the text accepts among the edits."""
        if stretch not in self._beside(stretch):
            insort(self.stretches, stretch)

    def _beside(self, stretch: Stretch) -> list[Stretch]:
        """Return the stretches in front of and behind a place; one that is further off is free."""
        behind = bisect_left(self.stretches, stretch)
        return self.stretches[max(behind - 1, 0) : behind + 1]

    @property
    def result(self) -> str:
        """The text after all edits."""
        pieces, end = [], 0
        for each in self.stretches:
            pieces += [self.source.text[end : each.start], each.replacement]
            end = each.end
        return "".join((*pieces, self.source.text[end:]))


def take(fix: Fix, texts: Mapping[str, EditedText]) -> bool:
    """Add all edits of a fix to the texts, or none; return whether they could be added."""
    wanted: list[tuple[EditedText, Stretch]] = []
    for edit in fix.edits:
        text = texts.get(edit.place.file)
        stretch = text.stretch(edit) if text is not None else None
        if text is None or stretch is None or not text.accepts(stretch):
            return False
        wanted.append((text, stretch))
    if _collide(wanted):
        return False
    for text, stretch in wanted:
        text.add(stretch)
    return True


def _collide(wanted: Iterable[tuple[EditedText, Stretch]]) -> bool:
    """Whether edits of one fix are at odds with each other."""
    ordered = sorted({(text.source.file, stretch) for text, stretch in wanted})
    return any(a[0] == b[0] and a[1].collides(b[1]) for a, b in pairwise(ordered))
