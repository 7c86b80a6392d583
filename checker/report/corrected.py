"""What the edits of a fix make of the lines that they are in."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.finding import SNIPPET_LIMIT, Edit, Fix


class Corrected(Record):
    """One line, or a longer stretch of text, before and after a fix.

    Attributes:
        is_line: Whether it is a whole line; else it is what one edit replaces.
    """

    file: str
    line: int
    before: str
    after: str
    is_line: bool


def corrected_lines(fix: Fix) -> Iterator[Corrected]:
    """Yield what a fix changes, in its order: the edits of one line together."""
    by_line: dict[tuple[str, int], list[Edit]] = {}
    for edit in fix.edits:
        by_line.setdefault((edit.place.file, edit.place.line), []).append(edit)
    for (file, line), edits in by_line.items():
        before, after = edits[0].place.snippet, _after(edits)
        if after is None:
            yield from (Corrected(file, line, it.original, it.replacement, False) for it in edits)
        else:
            written = after.replace("\r\n", "\n").strip()
            yield _without_kept(Corrected(file, line, before.strip(), written, True))


def _without_kept(line: Corrected) -> Corrected:
    """Leave out a line that stays as it is, behind which others are added."""
    if not _ELEMENTS.fullmatch(line.before) or not line.after.startswith(f"{line.before}\n"):
        return line
    return replace(line, before="", after=line.after.removeprefix(line.before).strip())


_ELEMENTS = re.compile(r"(?:<.*)?(?:/>|</[^<>]*>)")
"""A line that ends an element: it does not say into what the added lines go."""


def _after(edits: Sequence[Edit]) -> str | None:
    """Return the line of some edits with all made; None where it is not known as a whole."""
    text = edits[0].place.snippet
    # Findings of several robots may each bring the same edit.
    once = {(it.place.column, it.place.end_column, it.replacement): it for it in edits}
    starts = [start for start, _, _ in once]
    if len({*starts}) < len(starts):  # values for several links, of which the line has one
        return None
    for _, edit in sorted(once.items(), reverse=True):
        place, start = edit.place, edit.place.column - 1
        end = place.end_column - 1
        if place.line != place.end_line or not end <= len(place.snippet) < SNIPPET_LIMIT:
            return None
        text = f"{text[:start]}{edit.replacement}{text[end:]}"
    return text or None
