"""Heredocs: where the body begins and ends, and which indentation `<<~` takes away."""

from __future__ import annotations

import re

from checker.base.record import Record
from checker.source.ruby import RubyNode

Range = tuple[int, int]

_INDENT = re.compile(r"[ \t]*")
_TAB = 8
"""Ruby counts a tab up to the next multiple of 8 columns."""


class HeredocBody(Record, eq=False):
    """The body of a heredoc.

    Attributes:
        raw: Escapes and `#{}` do not count (`<<'XML'`).
        parts: Stretches of source, and the interpolations between them, in order.
    """

    raw: bool
    parts: tuple[list[Range] | RubyNode, ...]


def heredoc_body(opening: RubyNode) -> HeredocBody | None:
    """Read a heredoc from its opening, or return None when its end was not found."""
    body = opening.heredoc
    if body is None or not body.children or body.broken:
        return None
    text = body.source.text
    start = text.find("\n", body.start) + 1
    end = text.rfind("\n", 0, body.children[-1].start) + 1
    raw = "'" in opening.text
    holes = [] if raw else [node for node in body.children if node.type == "interpolation"]
    stretches: list[Range] = []
    for hole in holes:
        stretches.append((start, hole.start))
        start = hole.end
    stretches.append((start, end))
    kept = (
        _dedented(text, stretches) if opening.text.startswith("<<~") else [[s] for s in stretches]
    )
    parts: list[list[Range] | RubyNode] = [kept[0]]
    for hole, ranges in zip(holes, kept[1:], strict=True):
        parts += [hole, ranges]
    return HeredocBody(raw, tuple(parts))


def _dedented(text: str, stretches: list[Range]) -> list[list[Range]]:
    """Cut each stretch into lines without the indentation that all lines share."""
    last = len(stretches) - 1
    lines = [
        _lines(text, start, end, begins=index == 0, hole=index < last)
        for index, (start, end) in enumerate(stretches)
    ]
    widths = [
        _width(text, start, indent_end)
        for stretch in lines
        for start, indent_end, end, begins in stretch
        if begins and not _blank(text, indent_end, end, end == stretches[-1][1])
    ]
    common = min(widths, default=0)
    return [
        [
            (_cut(text, start, indent_end, common) if begins else start, end)
            for start, indent_end, end, begins in stretch
        ]
        for stretch in lines
    ]


def _lines(
    text: str, start: int, end: int, *, begins: bool, hole: bool
) -> list[tuple[int, int, int, bool]]:
    """Return each line as its start, the end of its indentation, its end, and if it begins here.

    The first line of a stretch behind `#{}` continues a line; a `#{}` in the first column
    (`hole`) is a line of its own without indentation.
    """
    found = []
    while start < end:
        line_end = text.find("\n", start, end) + 1 or end
        indent = _INDENT.match(text, start, line_end)
        found.append((start, indent.end() if indent else start, line_end, begins))
        start, begins = line_end, text[line_end - 1] == "\n"
    if hole and begins:
        found.append((end, end, end, True))
    return found


def _blank(text: str, indent_end: int, end: int, last: bool) -> bool:
    """Whether a line holds nothing but blanks; `#{}` behind the indentation is something."""
    rest = text[indent_end:end]
    return rest in {"\n", "\r\n"} or (rest == "" and last)


def _width(text: str, start: int, end: int) -> int:
    width = 0
    for char in text[start:end]:
        width = width // _TAB * _TAB + _TAB if char == "\t" else width + 1
    return width


def _cut(text: str, start: int, end: int, common: int) -> int:
    """Return the start of the line without `common` columns of indentation."""
    width = 0
    while start < end and width < common:
        after = width // _TAB * _TAB + _TAB if text[start] == "\t" else width + 1
        if after > common:
            break
        width, start = after, start + 1
    return start
