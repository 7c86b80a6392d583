"""A stretch of a file read as a text of its own, with the places of the file."""

from __future__ import annotations

from dataclasses import field

from checker.finding import Place
from checker.record import record
from checker.source.markup import blank_markup
from checker.source.text import SourceText, Span


@record(eq=False)
class Excerpt(SourceText):
    """A text inside another one; places are those of the outer text.

    Attributes:
        outer: The whole text.
        offset: Characters in front of the excerpt.
    """

    outer: SourceText = field(repr=False)
    offset: int

    def place(self, start: int, end: int) -> Place:
        """Return the place in the outer text."""
        return self.outer.place(start + self.offset, end + self.offset)


def text_excerpt(span: Span) -> Excerpt:
    """Return the text of an XML element, the indentation of its first line included.

    Args:
        span: From the first to the last character of the text.
    """
    source, start = span.source, span.start
    text = source.text
    line_start = text.rfind("\n", 0, start) + 1
    if not text[line_start:start].strip(" "):
        start = line_start
    return Excerpt(source.file, blank_markup(text[start : span.end]), source, start)
