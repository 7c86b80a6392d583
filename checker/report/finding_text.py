"""Text of one finding for a terminal: place, message, source line, reason and correction."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Sequence
from itertools import chain

from checker.base.words import count, plain, shortened
from checker.finding import Place, Severity
from checker.report.corrected import corrected_lines
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport, ReportedFinding

MORE_PLACES = 3
"""So many places of a repeated fault are named; the rest is counted."""

MESSAGE_LIMIT = 600
SNIPPET_WIDTH = 160
_ELEMENT = re.compile(r"<(\w+)>[^<>]*</\1>")
_FIRST = 2
"""So many elements are shown of those that are too long together."""


def finding_text(
    finding: ReportedFinding, package: PackageReport, settings: RenderSettings, explained: bool
) -> Iterator[str]:
    """Yield the lines of a finding.

    Args:
        finding: What was found.
        package: The package of the finding; its path is in front of each file.
        settings: Colours, and whether source line and reason are shown.
        explained: Whether why and how were stated before, for another finding of the rule.
    """
    place = finding.places[0]
    message = plain(shortened(finding.message, MESSAGE_LIMIT))
    severity = settings.palette.severity(finding.severity)
    yield f"{where_text(place, package)} {severity} {finding.rule} {finding.name}: {message}"
    if settings.full and finding.severity is not Severity.INFO:
        yield from _frame(place, settings.palette)
    others = [it for it in finding.places[1:] if not _is_same_spot(it, place)]
    if again := len(finding.places[1:]) - len(others):
        yield f"    {again} more from the same line"
    yield from _other_places(others, package)
    for rule, name in dict.fromkeys((repeat.rule, repeat.name) for repeat in finding.repeats):
        yield f"    also {rule} {name}"
    if finding.severity is Severity.INFO:
        return
    if finding.why and settings.full and not explained:
        yield f"    why: {finding.why}"
    if corrected := _what_to_write(finding, package):
        yield f"    fix: write {corrected}"
    elif finding.how and not explained:
        yield f"    fix: {finding.how}"


def _what_to_write(finding: ReportedFinding, package: PackageReport) -> str:
    """Return the lines as the fix writes them, and where if in another file; empty if long.

    Of many whole elements, such as dependencies, the first ones are shown.
    """
    lines = list(corrected_lines(finding.fix)) if finding.fix else []
    files = {it.file for it in lines}
    if len(files) != 1 or not all(it.is_line and it.after for it in lines):
        return ""
    parts = [[part.strip() for part in it.after.split("\n")] for it in lines]
    text, more = plain(" ".join(dict.fromkeys(map(" ".join, parts)))), ""
    every = [*chain.from_iterable(parts)]
    if len(text) > SNIPPET_WIDTH and all(map(_ELEMENT.fullmatch, every)):
        text, left = plain(" ".join(every[:_FIRST])), len(every) - _FIRST
        more = f" and {count(left, 'more line')}" if left > 0 else ""
    if "\n" in text or len(text) > SNIPPET_WIDTH:
        return ""
    if files == {finding.places[0].file}:
        return f"`{text}`{more}"
    place = Place(lines[0].file, lines[0].line)
    return f"`{text}`{more} at {where_text(place, package)}"


def path_of(place: Place, package: PackageReport) -> str:
    """Return the path of a place's file, relative to the working folder."""
    return posixpath.normpath(posixpath.join(package.path, place.file or "."))


def where_text(place: Place, package: PackageReport) -> str:
    """Return a place as editors and terminals understand it; a folder has no line."""
    return plain(path_of(place, package)) + (f":{place.line}:{place.column}" if place.file else "/")


def _is_same_spot(other: Place, place: Place) -> bool:
    """Return whether a line, such as that of a macro, makes the same fault again."""
    spot = (place.file, place.line, place.column)
    return not other.note and bool(place.line) and (other.file, other.line, other.column) == spot


def _other_places(places: Sequence[Place], package: PackageReport) -> Iterator[str]:
    own = [(place, place.note or place.message) for place in places]
    noted = [(place, words) for place, words in own if words]
    named = [where_text(place, package) for place, words in own if not words][:MORE_PLACES]
    for other, words in noted[:MORE_PLACES]:
        yield f"    {where_text(other, package)}: {plain(shortened(words, MESSAGE_LIMIT))}"
    more = len(places) - len(noted[:MORE_PLACES]) - len(named)
    parts = [f"also {', '.join(named)}"] if named else []
    parts += [f"and {count(more, 'more place')}"] if more else []
    if parts:
        yield f"    {' '.join(parts)}"


def _frame(place: Place, palette: Palette) -> Iterator[str]:
    """Show the source line with a caret below the marked text, if the snippet reaches so far."""
    column = place.column - 1
    if not place.snippet.strip() or column >= len(place.snippet):
        return
    end = place.end_column - 1 if place.end_line == place.line else len(place.snippet)
    start = max(0, min(column - 40, len(place.snippet) - SNIPPET_WIDTH))
    shown = plain(place.snippet.expandtabs(1))[start : start + SNIPPET_WIDTH]
    width = max(1, min(end, start + SNIPPET_WIDTH) - column)
    number = str(place.line)
    yield f"    {palette.dim(number + ' |')} {shown.rstrip()}"
    yield f"    {' ' * len(number)} {palette.dim('|')} {' ' * (column - start)}{'^' * width}"
