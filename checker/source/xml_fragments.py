"""XML texts without one outermost element, such as those of a spawner."""

from __future__ import annotations

import re
from typing import ClassVar

from checker.finding import Place
from checker.source.text import SourceText, Span
from checker.source.xml import XmlDocument, parse_xml
from checker.source.xml_positions import XmlFault

ROOT = "emitted"
_DECLARATION = re.compile(r"\A\s*<\?xml\s[^>]*\?>")


class WrappedText(SourceText, kw_only=True):
    """A text inside an element that only the parser sees; places are those of the inner text.

    Attributes:
        inner: The text without the wrapping.
        offset: Characters in front of it.
    """

    wrapper: ClassVar[str] = ROOT

    inner: SourceText
    offset: int

    def place(self, start: int, end: int) -> Place:
        """Return the place in the inner text."""
        last = len(self.inner.text)
        first = min(max(start - self.offset, 0), last)
        return self.inner.place(first, min(max(end - self.offset, first), last))


def parse_fragments(source: SourceText) -> XmlDocument | XmlFault:
    """Parse any number of elements side by side; they are below an element `emitted`."""
    opening = f"<{ROOT}>"
    inner = _DECLARATION.sub(lambda match: " " * len(match.group()), source.text)
    text = f"{opening}{inner}</{ROOT}>"
    return parse_xml(WrappedText(source.file, text, inner=source, offset=len(opening)))


def unwrapped(span: Span) -> tuple[int, int]:
    """Return the offsets of a span in the text that was passed to `parse_fragments`."""
    offset = span.source.offset if isinstance(span.source, WrappedText) else 0
    return span.start - offset, span.end - offset
