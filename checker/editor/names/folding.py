"""Parts of an XML text that an editor may fold: elements and comments over several lines.

The text is scanned as it is, so that folds stay while it is being written.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from enum import StrEnum

from checker.base.record import Record
from checker.editor.xml_context import markup_in
from checker.source.text import SourceText

LIMIT = 50_000
"""Folds of one file."""


class FoldKind(StrEnum):
    """Kind of thing that is folded."""

    ELEMENT = "element"
    COMMENT = "comment"


class Fold(Record):
    """Lines that can be folded.

    Attributes:
        start_line: The line that stays, from 1.
        end_line: The last line that is hidden; the end tag of an element stays.
        kind: What they are.
    """

    start_line: int
    end_line: int
    kind: FoldKind


def folds_of(source: SourceText) -> tuple[Fold, ...]:
    """Return what can be folded in an XML text, by first line, the outer before the inner."""
    found: dict[tuple[int, int], Fold] = {}
    for start, end, kind in _regions(source.text):
        first, last = source.position(start)[0], source.position(end)[0]
        if first < last and len(found) < LIMIT:
            found.setdefault((first, -last), Fold(first, last, kind))
    return tuple(found[key] for key in sorted(found))


def _regions(text: str) -> Iterator[tuple[int, int, FoldKind]]:
    """Yield the offsets of what may be folded: its first character, and one on its last line.

    An end tag closes the innermost element of its name, and all that is open in it; one that
    closes nothing is ignored.
    """
    open_tags: list[tuple[str, int]] = []
    names: Counter[str] = Counter()
    for markup in markup_in(text, 0, len(text)):
        name, start = markup.name, markup.start
        if not markup.is_whole:
            continue
        if markup.kind == "!":
            if text.startswith("<!--", start):
                yield start, markup.end - 1, FoldKind.COMMENT
        elif markup.is_empty:
            yield start, markup.end - 1, FoldKind.ELEMENT
        elif markup.kind == "<":
            open_tags.append((name, start))
            names[name] += 1
        elif names[name]:
            # The line in front of the end tag, unless something else is on the end tag's own.
            line_start = text.rfind("\n", 0, start) + 1
            is_alone = not text[line_start:start].strip()
            end = line_start - 1 if is_alone else start
            yield _closed(open_tags, names, name), end, FoldKind.ELEMENT


def _closed(open_tags: list[tuple[str, int]], names: Counter[str], name: str) -> int:
    """Close the innermost element of a name; return where it starts."""
    while True:
        closed, start = open_tags.pop()
        names[closed] -= 1
        if closed == name:
            return start
