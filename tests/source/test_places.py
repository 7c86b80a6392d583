"""Places of elements, attributes and texts, written out one by one."""

from __future__ import annotations

import pytest

from checker.finding import Place
from checker.source.text import SourceText
from checker.source.text_file import NotText, decode
from checker.source.xml import XmlDocument
from checker.source.xml_fragments import parse_fragments
from tests.source.documents import document


def corners(place: Place) -> tuple[int, int, int, int]:
    return place.line, place.column, place.end_line, place.end_column


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<r>\n <mass>5</mass></r>", (2, 8, 2, 9)),
        ("<r>\r\n <mass>5</mass></r>", (2, 8, 2, 9)),
        ("<r>\n\t<mass>5</mass></r>", (2, 8, 2, 9)),
        ("<größe>\n <mass> 5 </mass></größe>", (2, 9, 2, 10)),
        ("<r>ö世😀<mass a='世>'>5</mass></r>", (1, 20, 1, 21)),
        ("<r><mass\n a='>'\n b=\"/>\">5</mass></r>", (3, 9, 3, 10)),
        ("<r><mass><!-- kg -->5<!-- <b>6</b> --></mass></r>", (1, 21, 1, 22)),
        ("<r><mass><?pi 7?>5</mass></r>", (1, 18, 1, 19)),
        ("<r><mass><![CDATA[ 5 ]]></mass></r>", (1, 20, 1, 21)),
        ("<r><mass>&#x35;</mass></r>", (1, 10, 1, 16)),
        ("<r><mass>5<unit/></mass></r>", (1, 10, 1, 11)),
    ],
)
def test_text(text: str, expected: tuple[int, int, int, int]) -> None:
    mass = document(text).find_all("//mass")[0]
    assert mass.text.value == "5"
    assert corners(mass.text.span.place()) == expected


@pytest.mark.parametrize("empty", ["<b/>", "<b></b>", "<b >  </b>", "<b\n/>", "<b><!-- --></b>"])
def test_an_empty_element_stands_where_its_text_would(empty: str) -> None:
    b = document(f"<a>{empty}<c/></a>").find_all("b")[0]
    assert not b.text.stated
    assert b.text.span.text == b.span.text == empty[: empty.index(">") + 1]
    assert b.whole_span.text == empty


def test_attributes_over_several_lines() -> None:
    a = document('<a\r\n  name = \'x > "y"\'\r\n\txyz="1\r\n 2"/>').root
    name, xyz = a.attribute("name"), a.attribute("xyz")
    assert name is not None
    assert xyz is not None
    assert (name.value, name.span.text) == ('x > "y"', 'x > "y"')
    assert corners(name.span.place()) == (2, 11, 2, 18)
    assert corners(xyz.span.place()) == (3, 7, 4, 3)
    assert corners(a.attribute_name_span("xyz").place()) == (3, 2, 3, 5)
    assert a.attribute("absent") is None


def test_prefixes() -> None:
    a = document("<a xmlns:u='U' xmlns:v='U' u:x='1' xml:lang='en'><v:b/></a>").root
    assert a.attributes == {"u:x": "1", "xml:lang": "en"}
    assert a.attribute_name_span("u:x").text == "u:x"
    assert a.children[0].tag == "v:b"


def test_paths_number_only_twins_without_names() -> None:
    root = document("<sdf><model name='m'><link/><link name='l'/><link/><x/></model></sdf>").root
    assert [element.path for element in root.descendants()] == [
        "sdf/model[m]",
        "sdf/model[m]/link[1]",
        "sdf/model[m]/link[l]",
        "sdf/model[m]/link[2]",
        "sdf/model[m]/x",
    ]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-32"])
def test_a_byte_order_mark_takes_no_column(encoding: str) -> None:
    text = '<?xml version="1.0" encoding="UTF-16"?><a ö="ü"/>'
    a = document(decode(text.encode(encoding))).root
    assert a.attributes == {"ö": "ü"}
    assert a.span.place().column == 40


def test_what_says_that_it_is_ascii_is_read_as_gazebo_reads_it() -> None:
    data = '<?xml version="1.0" encoding="ASCII"?><!-- a – b --><a/>'.encode()
    assert document(decode(data)).root.tag == "a"


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"\x7fELF\x00\x00", "NUL"),
        (b"<a>\xff</a>", "byte 3"),
        (b'<?xml version="1.0" encoding="klingon"?><a/>', "klingon"),
        (b'<?xml version="1.0" encoding="punycode"?><a/>', "punycode"),
        (b"\xff\xfe<", "UTF-16"),
    ],
)
def test_what_is_no_text(data: bytes, reason: str) -> None:
    with pytest.raises(NotText, match=reason):
        decode(data)


def test_fragments_answer_in_their_own_text() -> None:
    source = SourceText("spawner.rb", '<?xml version="1.0"?><a/>\n<b>5</b>')
    parsed = parse_fragments(source)
    assert isinstance(parsed, XmlDocument)
    a, b = parsed.root.children
    assert corners(a.span.place()) == (1, 22, 1, 26)
    assert corners(b.text.span.place()) == (2, 4, 2, 5)
    assert b.text.span.place().snippet == "<b>5</b>"


def test_stray_texts_stand_beside_elements() -> None:
    root = document('<a> "\n<!-- x --> one <b>text</b><c/> two\n</a>').root
    assert [span.text for span in root.stray_texts] == ['"\n<!-- x --> one', "two"]
    assert [span.line for span in root.stray_texts] == [1, 2]
    assert not list(root.children[0].stray_texts)
