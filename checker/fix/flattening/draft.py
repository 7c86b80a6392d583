"""What is to become of one element's text: changes gathered, then written out at once."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape

from checker.finding import Edit
from checker.source.text import Located, SourceText, Span
from checker.source.xml import Element
from checker.source.xml_insertion import insertion, with_blanks

Change = tuple[int, int, str]
"""Characters from the first offset up to the second, and what is to stand there."""


@dataclass
class Draft:
    """Changes of a text that do not overlap."""

    source: SourceText
    changes: list[Change] = field(default_factory=list)

    def put(self, span: Span, text: str) -> None:
        """Have a text stand in place of a stretch."""
        self.changes.append((span.start, span.end, text))

    def name(self, named: Located[str] | None, new: str) -> None:
        """Have another name stand where one is written."""
        if named is not None and named.stated and named.value != new:
            self.put(named.span, written(new))

    def attribute(self, element: Element, name: str, value: str) -> None:
        """Give an element an attribute, or another value of it."""
        if element.attribute(name) is not None:
            self.name(element.attribute(name), value)
            return
        end = element.name_span.end
        behind = Span(element.source, end, end, element)
        self.put(behind, f' {name}="{written(value)}"')

    def take_attribute(self, element: Element, name: str) -> None:
        """Leave out an attribute."""
        self.put(element.whole_attribute_span(name), "")

    def insert(self, parent: Element, line: str) -> None:
        """Have an element stand first in another one."""
        span, text = insertion(parent, [line])
        self.put(span, text)

    def take_out(self, span: Span) -> None:
        """Leave out a stretch and its line."""
        self.put(with_blanks(span), "")

    def text(self, start: int, end: int) -> str:
        """Return the characters between two offsets with all changes made."""
        pieces, at = [], start
        for first, behind, new in sorted(self.changes):
            if start <= first and behind <= end:
                pieces += [self.source.text[at:first], new]
                at = behind
        return "".join((*pieces, self.source.text[at:end]))

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The changes as edits of the file."""
        return tuple(
            Span(self.source, start, end).replaced_by(new)
            for start, end, new in sorted(self.changes)
        )


def written(text: str) -> str:
    """Return a text as it is written in XML, inside of an element or an attribute."""
    return escape(text)
