"""A line of source with the fault marked, and what a fix makes of it."""

from __future__ import annotations

from collections.abc import Iterator

from checker.finding import SNIPPET_LIMIT, Edit, Fix, Place
from checker.record import record
from checker.report.wording import plain, shortened

WIDTH = 400
"""Characters of a line that are shown."""
_LEAD = 120
"""Of them at most in front of the mark."""
_EDITS_SHOWN = 20
_LINES_SHOWN = 20


@record()
class Frame:
    """A line of source in three parts; the middle one is what the finding is about."""

    line: int
    before: str
    marked: str
    after: str


@record()
class Change:
    """What one edit does, line by line."""

    file: str
    line: int
    removed: tuple[str, ...]
    added: tuple[str, ...]


def frame_of(place: Place) -> Frame | None:
    """Return the line of a place; None where it is blank or not known."""
    text = plain(place.snippet.expandtabs(1))
    if not text.strip() or place.column > len(text):
        return None
    start = place.column - 1
    end = place.end_column - 1 if place.end_line == place.line else len(text)
    end = max(end, start)
    indent = min(len(text) - len(text.lstrip()), start)
    first = max(indent, start - _LEAD)
    before = ("…" if first > indent else "") + text[first:start]
    marked = shortened(text[start:end], WIDTH)
    return Frame(place.line, before, marked, shortened(text[end:], WIDTH).rstrip())


def changes_of(fix: Fix) -> Iterator[Change]:
    """Yield what a fix changes, edit by edit; a long one is cut."""
    for edit in fix.edits[:_EDITS_SHOWN]:
        removed, added = _lines_around(edit)
        yield Change(plain(edit.place.file), edit.place.line, _shown(removed), _shown(added))


def _lines_around(edit: Edit) -> tuple[str, str]:
    """Return the whole lines before and after an edit, where the place knows them."""
    place = edit.place
    known = place.end_column - 1 <= len(place.snippet) < SNIPPET_LIMIT
    if place.end_line == place.line and place.snippet and known:
        head, tail = place.snippet[: place.column - 1], place.snippet[place.end_column - 1 :]
        return place.snippet.strip(), f"{head}{edit.replacement}{tail}".strip()
    return edit.original, edit.replacement


def _shown(text: str) -> tuple[str, ...]:
    lines = [shortened(plain(line.expandtabs(2)), WIDTH) for line in text.split("\n")]
    if len(lines) > _LINES_SHOWN:
        lines = [*lines[:_LINES_SHOWN], f"… {len(lines) - _LINES_SHOWN} more lines"]
    return tuple(lines) if text.strip() else ()
