"""Elements put into XML by a text edit: well-formed, in front, laid out like their neighbours."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.finding import Edit
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from checker.source.xml_insertion import append_to, insert_into, removal

NEW = ["<new>", "  <inner>1</inner>", "</new>"]


def parsed(text: str) -> XmlDocument:
    document = parse_xml(SourceText("model.sdf", text))
    assert isinstance(document, XmlDocument)
    return document


def edited(text: str, edit: Edit) -> str:
    lines = text.splitlines(keepends=True)

    def offset(line: int, column: int) -> int:
        return sum(map(len, lines[: line - 1])) + column - 1

    start = offset(edit.place.line, edit.place.column)
    end = offset(edit.place.end_line, edit.place.end_column)
    assert text[start:end] == edit.original
    return text[:start] + edit.replacement + text[end:]


def inserted(text: str) -> str:
    (parent,) = parsed(text).find_all("//parent")
    return edited(text, insert_into(parent, NEW))


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "<a>\n  <parent>\n    <b/>\n  </parent>\n</a>",
            "<a>\n  <parent>\n    <new>\n      <inner>1</inner>\n    </new>\n    <b/>\n"
            "  </parent>\n</a>",
        ),
        (
            "<a>\r\n\t<parent>\r\n\t\t<b/>\r\n\t</parent>\r\n</a>",
            "<a>\r\n\t<parent>\r\n\t\t<new>\r\n\t\t\t<inner>1</inner>\r\n\t\t</new>\r\n\t\t<b/>\r\n"
            "\t</parent>\r\n</a>",
        ),
        (
            "<a>\n    <parent name='p' />\n</a>",
            "<a>\n    <parent name='p'>\n        <new>\n            <inner>1</inner>\n"
            "        </new>\n    </parent>\n</a>",
        ),
        (
            "<a>\n  <parent></parent>\n</a>",
            "<a>\n  <parent>\n    <new>\n      <inner>1</inner>\n    </new>\n  </parent>\n</a>",
        ),
        (
            "<a><parent><b/></parent></a>",
            "<a><parent><new><inner>1</inner></new><b/></parent></a>",
        ),
        ("<a><parent/></a>", "<a><parent><new><inner>1</inner></new></parent></a>"),
    ],
    ids=["as neighbours", "tabs and CRLF", "empty tag", "empty element", "one line", "both"],
)
def test_what_is_put_in_stands_as_its_neighbours_do(before: str, after: str) -> None:
    assert inserted(before) == after


BLANKS = st.text(" \t\n", max_size=6)
INSIDE = st.lists(st.sampled_from(["<b/>", "<b>2</b>", "<!-- c -->"]), max_size=3)


@given(BLANKS, BLANKS, INSIDE, st.booleans())
def test_however_a_file_is_laid_out_the_new_element_comes_first(
    outside: str, within: str, inside: list[str], closed: bool
) -> None:
    content = within.join(["", *inside, ""])
    parent = f"<parent{within}/>" if closed else f"<parent>{content}</parent>"
    before = f"<a>{outside}{parent}{outside}</a>"
    (had,) = parsed(before).find_all("//parent")
    (has,) = parsed(inserted(before)).find_all("//parent")
    assert [child.tag for child in has.children] == ["new", *(c.tag for c in had.children)]
    assert [e.tag for e in has.children[0].descendants()] == ["inner"]
    assert [s.text.strip() for s in parsed(inserted(before)).root.stray_texts] == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("<a>\n  <old>1</old>\n  <b/>\n</a>", "<a>\n  <b/>\n</a>"),
        ("<a><old>1</old><b/></a>", "<a><b/></a>"),
        ("<a>\n  <old>\n  </old> <!-- c -->\n</a>", "<a>\n  <!-- c -->\n</a>"),
    ],
    ids=["line", "amid a line", "with a comment behind"],
)
def test_what_is_taken_out_leaves_no_empty_line(before: str, after: str) -> None:
    (old,) = parsed(before).find_all("//old")
    assert edited(before, removal(old)) == after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("<a> <!-- c -->\n  <b/>\n</a>", "<a> <!-- c -->\n  <n/>\n  <b/>\n</a>"),
        ("<a> <!-- c -->\n</a>", "<a> <!-- c -->\n  <n/>\n</a>"),
        ("<a>\n  <!-- c -->\n</a>", "<a>\n  <n/>\n  <!-- c -->\n</a>"),
        ("<a> <!-- c\n --><b/></a>", "<a><n/> <!-- c\n --><b/></a>"),
    ],
    ids=["behind the tag", "of an empty one", "on its own line", "of several lines"],
)
def test_a_comment_stays_with_its_line(before: str, after: str) -> None:
    (parent,) = parsed(before).find_all("//a")
    assert edited(before, insert_into(parent, ["<n/>"])) == after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("<a>\n  <b/> <!-- c -->\n</a>", "<a>\n  <b/> <!-- c -->\n  <n/>\n</a>"),
        ("<a><b/></a>", "<a><b/><n/></a>"),
        ("<a/>", "<a>\n  <n/>\n</a>"),
    ],
)
def test_elements_are_put_behind_others(before: str, after: str) -> None:
    (parent,) = parsed(before).find_all("//a")
    assert edited(before, append_to(parent, ["<n/>"])) == after
