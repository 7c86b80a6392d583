"""What can be folded in an XML text, whole or half written."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.editor.names.folding import FoldKind, folds_of
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from tests.effort import limited


def folds(text: str) -> list[tuple[int, int, str]]:
    return [
        (it.start_line, it.end_line, it.kind.value) for it in folds_of(SourceText("a.sdf", text))
    ]


TEXT = """<?xml version="1.0"?>
<sdf>
  <!-- one
       two -->
  <model name="a > b">
    <link name="l"/>
    <pose>0
    0</pose>
    <plugin
      name="p"
      filename="f"/>
  </model>
  <one>line</one>
</sdf>
"""


def test_elements_and_comments_over_several_lines() -> None:
    assert folds(TEXT) == [
        (2, 13, "element"),
        (3, 4, "comment"),
        (5, 11, "element"),
        (7, 8, "element"),
        (9, 11, "element"),
    ]


def test_a_half_written_text_keeps_the_folds_that_it_has() -> None:
    for broken, number in (
        (TEXT.replace("</sdf>", ""), 4),
        (TEXT.replace("  </model>\n", ""), 4),
        (TEXT.replace('<link name="l"/>', "<link na"), 5),
        (TEXT.replace('<link name="l"/>', '<link name="l'), 5),
        (TEXT.replace("</pose>", "</pos>"), 4),
        (TEXT.replace("<model", "</gone>\n<model"), 5),
        (TEXT.replace(" two -->", " two "), 1),
    ):
        assert len(folds(broken)) >= number - 1, broken
        assert all(first < last for first, last, _ in folds(broken))


def test_what_looks_like_a_tag_in_comments_and_data_is_none() -> None:
    assert folds("<a><!-- <b>\n</b> -->\n</a>") == [(1, 2, "comment")]
    assert folds("<a><![CDATA[<b>\n</b>\n]]>\n</a>") == [(1, 3, "element")]


def test_line_ends_of_other_systems() -> None:
    assert folds(TEXT.replace("\n", "\r\n")) == folds(TEXT)


@given(st.text(alphabet="<>/!-ab\"'= \n[]?", max_size=80))
def test_any_text_is_folded_without_crossing(text: str) -> None:
    found = [it for it in folds(text) if it[2] == FoldKind.ELEMENT]
    lines = text.count("\n") + 1
    assert all(1 <= first < last <= lines for first, last, _ in found)


def test_a_well_formed_text_folds_as_its_elements_lie(samples: Path) -> None:
    for path in sorted(samples.glob("*/*.sdf")) + sorted(samples.glob("*/urdf/*")):
        source = SourceText(path.name, path.read_text())
        document = parse_xml(source)
        if not isinstance(document, XmlDocument):
            continue
        expected = set()
        for element in document.elements:
            start, end = element.position.start, element.position.end_start
            line_start = source.text.rfind("\n", 0, end) + 1
            if not source.text[line_start:end].strip() and end != element.position.end:
                end = line_start - 1
            elif end == element.position.end:
                end -= 1
            lines = source.position(start)[0], source.position(end)[0]
            expected |= {lines} if lines[0] < lines[1] else set()
        found = {(first, last) for first, last, kind in folds(source.text) if kind == "element"}
        assert found == expected, path


@pytest.mark.slow
def test_folding_is_linear() -> None:
    with limited(3):
        for text in ("<a>\n" * 100_000, "<a " * 200_000, '<a "' * 100_000, "<!--" * 100_000):
            folds(text + "</a>" * 1000)
        folds("<a>\n" * 50_000 + "</b>\n" * 50_000 + "</a>\n" * 50_000)
