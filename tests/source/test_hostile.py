"""Texts made to exhaust a reader: cost grows with the length and no faster."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from checker.source.text import SourceText
from checker.source.xml import MAX_DEPTH, XmlDocument, parse_xml
from checker.source.xml_positions import XmlFault
from tests.effort import grows_linearly, large
from tests.source.documents import document, fault

Texts = Callable[[int], str]

# name, text of a size, size
GROWING: dict[str, tuple[Texts, int]] = {
    "siblings": (lambda n: f"<r>{'<a>1</a>' * n}</r>", 10_000),
    "letters beyond ASCII": (lambda n: "<r>" + '<a ö="ü">世</a>' * n + "</r>", 10_000),
    "a long name": (lambda n: f"<{'n' * n}/>", 1_000_000),
    "a long text": (lambda n: f"<a>{'x' * n}</a>", 4_000_000),
    "many attributes": (lambda n: "<a" + "".join(f' a{i}="1"' for i in range(n)) + "/>", 20_000),
    "undeclared prefixes": (lambda n: f"<r>{''.join(f'<x{i}:a/>' for i in range(n))}</r>", 5_000),
    "comments with hyphens": (lambda n: f"<r>{'<!-- -- -->' * n}</r>", 20_000),
    "comments that never end": (lambda n: "<r>" + "<!-- " * n, 200_000),
    "comments in one text": (lambda n: f"<r>{'x<!--y-->' * n}</r>", 20_000),
    "opening brackets": (lambda n: "<" * n, 1_000_000),
    "blanks": (lambda n: f"<a{' ' * n}>{' ' * n}</a>", 1_000_000),
}


def read(text: str) -> None:
    parsed = parse_xml(SourceText("f", text))
    if isinstance(parsed, XmlDocument):
        for element in parsed.elements:
            assert element.span.end > element.span.start
            assert element.text.span.end > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", GROWING)
def test_four_times_the_text_costs_no_square(name: str) -> None:
    text, size = GROWING[name]
    size = large(size)
    short, long = text(size), text(4 * size)
    assert grows_linearly(lambda: read(short), lambda: read(long))


@pytest.mark.parametrize("closed", [True, False])
def test_deep_nesting_is_a_fault(closed: bool) -> None:
    found = fault("<a>" * 100_000 + "</a>" * (100_000 * closed))
    assert "nested more than" in found.message
    assert found.span.start == 3 * MAX_DEPTH


def test_the_deepest_that_is_read() -> None:
    deepest = document("<a>" * MAX_DEPTH + "</a>" * MAX_DEPTH).elements[-1]
    assert deepest.path.endswith("a/a")
    assert deepest.whole_span.text == "<a></a>"


def test_paths_stay_short() -> None:
    parsed = document("".join(f'<a name="{"x" * 10_000}">' for _ in "12") + "</a></a>")
    assert len(parsed.elements[1].path) < 500


@pytest.mark.parametrize(
    "declarations",
    [
        '<!ENTITY a "aaaaaaaa">' + "".join(f'<!ENTITY a{i} "&a;&a;&a;">' for i in range(10_000)),
        '<!ENTITY a SYSTEM "file:///etc/passwd">',
        '<!ENTITY a SYSTEM "http://localhost:9/">',
        '<!ENTITY % a SYSTEM "file:///etc/passwd"> %a;',
    ],
)
def test_entities_are_refused_unread(declarations: str) -> None:
    found = fault(f"<!DOCTYPE r [{declarations}]>\n<r>&a;</r>")
    assert isinstance(found, XmlFault)
    assert "DOCTYPE" in found.message
    assert found.span.line == 1
