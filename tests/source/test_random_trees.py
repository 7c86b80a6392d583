"""Whatever the formatting: every place marks exactly what stands there."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from checker.source.text import SourceText, Span
from checker.source.text_file import decode
from checker.source.xml import Element, XmlDocument
from checker.source.xml_fragments import parse_fragments, unwrapped
from tests.effort import examples
from tests.source.documents import document
from tests.source.trees import Page, Written, pages

ENCODINGS = st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "utf-32"])


def encoded(text: str, encoding: str) -> bytes:
    mark = "\ufeff" if encoding == "utf-16-be" else ""
    return (mark + text).encode(encoding)


@settings(max_examples=examples(300))
@given(pages(), ENCODINGS)
def test_every_place_of_a_file(page: Page, encoding: str) -> None:
    text = decode(encoded(page.text, encoding))
    assert text == page.text
    compare(document(text).elements, page.elements)


@settings(max_examples=examples(100))
@given(st.lists(pages(), max_size=3))
def test_every_place_of_fragments(parts: list[Page]) -> None:
    parts = [part for part in parts if not part.text.startswith("<?xml")]
    text = "\r\n".join(part.text for part in parts)
    parsed = parse_fragments(SourceText("spawner.rb", text))
    assert isinstance(parsed, XmlDocument)
    found = parsed.elements[1:]
    expected = [element for part in parts for element in part.elements]
    assert [element.tag for element in found] == [element.tag for element in expected]
    for element, written in zip(found, expected, strict=True):
        start, end = unwrapped(element.name_span)
        assert text[start:end] == written.tag
        place = element.name_span.place()
        assert place.column == start - (text.rfind("\n", 0, start) + 1) + 1
        assert place.line == text.count("\n", 0, start) + 1


def compare(found: list[Element], expected: list[Written]) -> None:
    assert [element.tag for element in found] == [element.tag for element in expected]
    for element, written in zip(found, expected, strict=True):
        position = element.position
        assert (position.start, position.start_end) == (written.start, written.start_end)
        assert (position.end_start, position.end) == (written.end_start, written.end)
        assert range_of(element.name_span) == written.name
        compare_attributes(element, written)
        assert element.text.value == written.text
        if written.text_range is None:
            assert element.text_span == element.span
        else:
            assert range_of(element.text_span) == written.text_range


def compare_attributes(element: Element, written: Written) -> None:
    assert element.attributes == {name: a[4] for name, a in written.attributes.items()}
    for name, (name_start, name_end, start, end, _) in written.attributes.items():
        assert range_of(element.attribute_name_span(name)) == (name_start, name_end)
        located = element.attribute(name)
        assert located is not None
        assert range_of(located.span) == (start, end)


def range_of(span: Span) -> tuple[int, int]:
    return span.start, span.end
