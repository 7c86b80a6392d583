"""Lines moved from one depth, or one file, to another."""

from __future__ import annotations

from collections.abc import Sequence

from checker.flattening.draft import Draft
from checker.source.insertion import indentation_of, newline_of
from checker.source.xml import Element

_BLANKS = " \t"


def lines_of(draft: Draft, start: int, end: int) -> list[str]:
    """Return what a draft makes of a stretch: lines, the first of them without indentation."""
    before = draft.source.text[draft.source.text.rfind("\n", 0, start) + 1 : start]
    outer = before if not before.strip() else ""
    lines = (outer + draft.text(start, end)).replace("\r\n", "\n").split("\n")
    while lines and not lines[0].strip():
        lines.pop(0)
    while lines and not lines[-1].strip():
        lines.pop()
    if not lines:
        return []
    shared = lines[0][: len(lines[0]) - len(lines[0].lstrip(_BLANKS))]
    lines[-1] = lines[-1].rstrip(_BLANKS)
    return [line.removeprefix(shared) if line.strip() else "" for line in lines]


def put_in_place_of(element: Element, lines: Sequence[str]) -> str:
    """Return lines as they stand where an element stood, whose own indentation stays."""
    indentation = indentation_of(element.source, element.position.start) or ""
    newline = newline_of(element.source, element.position.start)
    if " " in indentation:
        lines = [_without_tabs(line) for line in lines]
    first, *others = lines or [""]
    return first + "".join(newline + indentation * bool(line) + line for line in others)


def _without_tabs(line: str) -> str:
    """Return a line of another file with blanks in front, as they stand around it."""
    text = line.lstrip(_BLANKS)
    return line[: len(line) - len(text)].replace("\t", "  ") + text
