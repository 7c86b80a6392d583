"""Text edits that put elements into XML, laid out like their surroundings, and take them out.

Edits are made in the file as it is written, also for an element that a macro made.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from checker.finding import Edit
from checker.source.text import SourceText, Span
from checker.source.xml import Element

_STEP = "  "
"""Indentation of a step of depth, where the file shows none."""
_BLANKS = (" ", "\t")


class Insertion(NamedTuple):
    """A stretch of text, and the new text with the elements."""

    span: Span
    text: str

    @property
    def edit(self) -> Edit:
        """The edit that makes it."""
        return self.span.replacement(self.text)


def insert_into(parent: Element, lines: Sequence[str]) -> Edit:
    """Return the edit that puts elements in front of those that an element contains.

    Args:
        parent: The element that is to hold them.
        lines: Their text, two blanks in front of a line for each step of depth.
    """
    return insertion(parent.written, lines).edit


def insertion(parent: Element, lines: Sequence[str]) -> Insertion:
    """Return what `insert_into` replaces, and by what, in the text of the element itself."""
    source, position = parent.source, parent.position
    outer, written = _written(parent, lines)
    if parent.span.text.endswith("/>"):
        opened = position.start + len(parent.span.text.removesuffix("/>").rstrip())
        tail = Span(source, opened, position.start_end, parent)
        return Insertion(tail, f">{written}{outer}</{parent.tag}>")
    start = end = _behind_comments(source, position.start_end)
    if not parent.children and not source.text[start : position.end_start].strip():
        end, written = position.end_start, written + outer
    return Insertion(Span(source, start, end, parent), written)


def append_to(parent: Element, lines: Sequence[str]) -> Edit:
    """Return the edit that adds elements after the children of an element; see `insert_into`."""
    children = parent.written.children
    last = children[-1] if children else None
    return insert_into(parent, lines) if last is None else insert_behind(last, lines)


def insert_behind(element: Element, lines: Sequence[str]) -> Edit:
    """Return the edit that puts elements behind another one; see `insert_into`."""
    element = element.written
    parent = element.parent or element
    end = _behind_comments(element.source, element.position.end)
    span = Span(element.source, end, end, parent)
    return span.replacement(_written(parent, lines)[1])


def _written(parent: Element, lines: Sequence[str]) -> tuple[str, str]:
    """Return the text before an end tag on its own line, and lines to insert."""
    outer, inner = _indentations(parent)
    if inner is None:
        return "", "".join(line.strip() for line in lines)
    step = inner[len(outer) :] if outer is not None and inner.startswith(outer) else ""
    newline = newline_of(parent.source, parent.position.start_end)
    written = "".join(newline + inner + _stepped(line, step or _STEP) for line in lines)
    return "" if outer is None else newline + outer, written


def _behind_comments(source: SourceText, offset: int) -> int:
    """Return the end of a line that contains only comments from here, else the offset itself."""
    text, at = source.text, offset
    while True:
        while text[at : at + 1] in _BLANKS:
            at += 1
        if not text.startswith("<!--", at):
            return at if at > offset and text.startswith(("\n", "\r\n"), at) else offset
        behind = text.find("-->", at) + len("-->")
        if behind < at or "\n" in text[at:behind]:
            return offset
        at = behind


def attribute_edits(element: Element, values: Mapping[str, str]) -> tuple[Edit, ...]:
    """Return the edits that give an element attributes, and those that it has other values."""
    return tuple(each.edit for each in with_attributes(element.written, values))


def with_attributes(element: Element, values: Mapping[str, str]) -> list[Insertion]:
    """Return what `attribute_edits` replace, and by what, in the text of the element itself."""
    stated = {name: element.attribute(name) for name in values}
    end = element.name_span.end
    added = "".join(f' {name}="{values[name]}"' for name, old in stated.items() if old is None)
    changed = [Insertion(old.span, values[name]) for name, old in stated.items() if old is not None]
    return [
        *([Insertion(Span(element.source, end, end, element), added)] if added else []),
        *changed,
    ]


def removal(element: Element) -> Edit:
    """Return the edit that takes an element out; see `with_blanks`."""
    return with_blanks(element.written.whole_span).replacement("")


def with_blanks(span: Span) -> Span:
    """Return a stretch with the blanks that would be left over if it were taken out.

    These are the rest of its lines when nothing else is there, else the blanks on one side.
    """
    source, start, end = span.source, span.start, span.end
    text, indentation = source.text, indentation_of(source, start)
    behind = end
    while text[behind : behind + 1] in _BLANKS:
        behind += 1
    ends_line = text.startswith(("\n", "\r\n"), behind)
    if indentation is not None and ends_line:
        start, end = start - len(indentation), text.index("\n", behind) + 1
    elif indentation is not None:
        end = behind
    elif behind > end or ends_line:
        while text[start - 1] in _BLANKS:
            start -= 1
    return Span(source, start, end, span.holder)


def _indentations(parent: Element) -> tuple[str | None, str | None]:
    """Return the indentation of an element and of what it contains; None amid a line."""
    outer = indentation_of(parent.source, parent.position.start)
    if parent.children:
        return outer, indentation_of(parent.source, parent.children[0].position.start)
    return outer, None if outer is None else outer + (_step_around(parent, outer) or _STEP)


def _step_around(element: Element, own: str) -> str:
    """Return how much further in an element stands than the one around it."""
    above = element.parent
    around = indentation_of(above.source, above.position.start) if above is not None else None
    return own[len(around) :] if around is not None and own.startswith(around) else ""


def indentation_of(source: SourceText, offset: int) -> str | None:
    """Return the blanks between the start of a line and an offset; None if more is there."""
    before = source.text[source.text.rfind("\n", 0, offset) + 1 : offset]
    return None if before.strip() else before


def newline_of(source: SourceText, offset: int = 0) -> str:
    """Return how the line ends that contains an offset, or the one before."""
    end = source.text.find("\n", offset)
    end = end if end >= 0 else source.text.rfind("\n")
    return "\r\n" if end > 0 and source.text[end - 1] == "\r" else "\n"


def _stepped(line: str, step: str) -> str:
    text = line.lstrip(" ")
    return step * ((len(line) - len(text)) // len(_STEP)) + text
