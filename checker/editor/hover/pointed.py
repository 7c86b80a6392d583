"""Tag, attribute or text at an offset of a well-formed document."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator

from checker.base.record import Record
from checker.editor.xml_context import Where
from checker.source.text import Span
from checker.source.xml import Element, XmlDocument


class Pointed(Record, eq=False):
    """Part of a document under the pointer.

    Attributes:
        element: The element that it belongs to.
        where: `TAG`, `ATTRIBUTE` (the name of one), `VALUE` or `TEXT`.
        span: The span.
        attribute: Name of the attribute; empty for a tag and a text.
    """

    element: Element
    where: Where
    span: Span
    attribute: str = ""

    @property
    def value(self) -> str:
        """The value of the attribute, or the text of the element."""
        if self.where is Where.TEXT:
            return self.element.value
        return self.element.attributes.get(self.attribute, "")

    @property
    def tags(self) -> tuple[str, ...]:
        """Tags from the root down to the element."""
        return tuple(reversed([element.tag for element in ancestry(self.element)]))


def ancestry(element: Element) -> Iterator[Element]:
    """Yield an element and those around it, the nearest first."""
    at: Element | None = element
    while at is not None:
        yield at
        at = at.parent


def pointed_at(document: XmlDocument, offset: int) -> Pointed | None:
    """Return what is at an offset; None between the things that state something."""
    elements = document.elements
    index = bisect_right(elements, offset, key=lambda element: element.position.start) - 1
    if index < 0:
        return None
    for element in ancestry(elements[index]):
        if offset <= element.position.end:
            return next((it for it in _things(element) if _covers(it.span, offset)), None)
    return None


def _covers(span: Span, offset: int) -> bool:
    return span.start <= offset <= span.end


def _things(element: Element) -> Iterator[Pointed]:
    yield Pointed(element, Where.TAG, element.name_span)
    if (end := element.end_name_span) is not None:
        yield Pointed(element, Where.TAG, end)
    for name in element.attributes:
        value = element.attribute(name)
        yield Pointed(element, Where.ATTRIBUTE, element.attribute_name_span(name), name)
        if value is not None:
            yield Pointed(element, Where.VALUE, value.span, name)
    if element.value:
        yield Pointed(element, Where.TEXT, element.text_span)
