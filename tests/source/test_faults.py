"""Texts that are not well-formed: the place, the message, the likely cause."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from checker.source.xml_fragments import parse_fragments
from checker.source.xml_positions import XmlFault
from tests.source.documents import document, fault

# text, place (line:column), what the message or the hint says
FAULTS = [
    ("", "1:1", "the file is empty"),
    (" \r\n\t", "1:1", "the file is empty"),
    ("<!-- nothing -->", "1:17", "contains no element"),
    ('<?xml version="1.0"?>\n', "2:1", "contains no element"),
    ("<a>\n <mass>3.6/mass>\n</a>", "3:1", "write </mass> for /mass> in line 2"),
    ("<a><mass>3.6/mass>", "1:19", "write </mass> for /mass> in line 1"),
    ('<l>\n<node> pkg="x"/>\n</l>', "3:1", "<node> is closed before its attributes"),
    ("<a>\n<b>\n</a>", "3:1", "</a> is here while <b> of line 2 is still open"),
    ("<link>\n<mass>1</mas></link>", "2:8", "write </mass>"),
    ("<a><b></c></b></a>", "1:7", "no <c> is open"),
    ("<a>\n<b>", "2:4", "<b> of line 2 is never closed"),
    ("<a/>\n<b/>", "2:1", "<b> follows it"),
    ("<a/> text", "1:6", "text follows it"),
    ("<a/></a>", "1:6", "no element left to close"),
    ("text", "1:1", "starts with <"),
    ("\x7fELF\x01", "1:1", "U+007F is not allowed"),
    ("<a>é\x01</a>", "1:5", "U+0001 is not allowed"),
    ("<a", "1:1", "has no >"),
    ("<a>\n<!-- <b/></a>", "2:1", "comment that starts here has no -->"),
    ("<a>\n<![CDATA[ </a>", "2:1", "has no ]]>"),
    ("<a>x & y</a>", "1:7", "write &amp; for &"),
    ("<a>&foo</a>", "1:8", "end the entity with ;"),
    ("<a>&foo;</a>", "1:4", "XML knows only &amp;"),
    ("<a>&#1;</a>", "1:4", "this number is not a character"),
    ("<a>é a < b</a>", "1:9", "write &lt; for <"),
    ('<a n="q/>\n<b m="x"/></a>', "2:1", "closing quote"),
    ('<a n="q" m\n<b/></a>', "2:1", "an attribute before this has no value"),
    ("<a b=1/>", "1:6", "needs quotes"),
    ("<a é=“1”/>", "1:6", "needs quotes"),
    ("<a b/>", "1:5", "needs a value"),
    ('<a b="1"c="2"/>', "1:9", "a space between them"),
    ('<a b="1" b="2"/>', "1:10", "duplicate attribute"),
    ("<a><b</a>", "1:6", "not closed by >"),
    ('<a b="1" <c/></a>', "1:10", "not closed by >"),
    ("<a></ a>", "1:6", "space after </"),
    ("<a>]]></a>", "1:6", "]]&gt;"),
    ("<a><!- x -></a>", "1:7", "a comment starts with <!--"),
    ("<a><b//></a>", "1:7", "ends with />"),
    ('<a><?xml version="1.0"?></a>', "1:4", "remove the second"),
    ('<!-- <b> -->\n<?xml version="1.0"?><a/>', "2:1", "move line 2, <?xml …?>, to the beginning"),
    ('<!DOCTYPE a [<!ENTITY b "c">]><a/>', "1:1", "document type"),
    ('<!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>', "1:1", "document type"),
]


@pytest.mark.parametrize(("text", "place", "says"), FAULTS)
def test_fault(text: str, place: str, says: str) -> None:
    found = fault(text)
    at = found.span.place()
    assert f"{at.line}:{at.column}" == place
    assert says in f"{found.message}: {found.hint}"


def test_the_place_does_not_depend_on_line_ends_and_letters_in_front() -> None:
    found = fault("<ä>\r\n<世>世</世>\r\n\t<b></ä>")
    assert str(found.span.place()) == "robot.launch:3:5"
    assert found.span.text == "</ä>"


@pytest.mark.parametrize(
    ("text", "marked", "says"),
    [
        ('\n <?xml version="1.0"?><a/>', '<?xml version="1.0"?>', "not at the very start"),
        ("<a><!-- b -- c --></a>", "--", "'--' inside a comment"),
        ("<a><!--- b ---></a>", "-", "'--' inside a comment"),
        ("<a>\n<é:b/><é:c/></a>", "é:b", "the prefix 'é' is not declared"),
        ("<a><b x:y='1'/></a>", "x:y", "the prefix 'x' is not declared"),
        ("<xacro:macro/>", "xacro:macro", "xmlns:xacro="),
    ],
)
def test_what_gazebo_forgives_is_tolerated(text: str, marked: str, says: str) -> None:
    first = document(text).tolerated[0]
    assert first.span.text == marked
    assert says in f"{first.message}: {first.hint}"


def test_each_undeclared_prefix_is_reported_once_and_its_tags_are_kept() -> None:
    parsed = document('<robot><xacro:a xacro:b="1"/><xacro:a/><gz:c/></robot>')
    assert [fault.span.text for fault in parsed.tolerated] == ["xacro:a", "gz:c"]
    assert [child.tag for child in parsed.root.children] == ["xacro:a", "xacro:a", "gz:c"]
    assert parsed.root.children[0].attributes == {"xacro:b": "1"}


def test_hyphens_in_cdata_are_no_comment() -> None:
    parsed = document("<a><!-- x -- --><![CDATA[<!-- y -- -->]]></a>")
    assert parsed.root.text.value == "<!-- y -- -->"
    assert len(parsed.tolerated) == 1


def test_a_fault_behind_a_tolerated_one_is_the_one_reported() -> None:
    assert fault("<a><!-- b -- c -->\n<d></a>").span.line == 2


@pytest.mark.parametrize(
    "text",
    [
        '<a><b xml:id="q"/><b xml:id="q"/></a>',
        '<a xml:id="1b"/>',
        '<a xmlns="no uri %%"/>',
        '<a xmlns:x=""/>',
        '<a xmlns:xml="u"/>',
        '<a:b:c xmlns:a="u"/>',
        "<:a :b='1'/>",
        '<?xml version="2.0"?><a/>',
        "<a><?b:c?></a>",
        '<a xmlns:b="u" xmlns:c="u" b:x="1" c:x="2"/>',
    ],
)
def test_what_lxml_alone_refuses_is_read(text: str) -> None:
    for element in document(text).elements:
        assert element.span.text.startswith(f"<{element.tag}")


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("<a/>\n</spawn>", "2:1", "</spawn> closes no open element"),
        ("<a>\n<b>", "2:4", "<b> of line 2 is never closed"),
        ("<mass>3/mass>", "1:14", "write </mass> for /mass>"),
        ("</emitted><emitted>", "1:11", "follows it"),
    ],
)
def test_faults_of_fragments_never_name_the_wrapping(text: str, place: str, says: str) -> None:
    found = parse_fragments(SourceText("f", text))
    assert isinstance(found, XmlFault)
    assert str(found.span.place()) == f"f:{place}"
    assert says in f"{found.message}: {found.hint}"


PIECES = [
    "<a>",
    "</a>",
    "<a",
    "/>",
    ">",
    "<!--",
    "-->",
    "--",
    "<![CDATA[",
    "]]>",
    "&",
    "&lt;",
    "x:",
]
PIECES += ['="', '"', "'", "<?xml ?>", "<!DOCTYPE a>", "é", "\0", "\r\n", " b", "\ufeff", "\ufffe"]


@given(st.lists(st.sampled_from(PIECES)).map("".join))
def test_no_text_raises(text: str) -> None:
    for parsed in (parse_xml(SourceText("f", text)), parse_fragments(SourceText("f", text))):
        if isinstance(parsed, XmlDocument):
            for element in parsed.elements:
                assert element.text.span.start <= element.text.span.end
                assert element.attributes.keys() >= set()
        else:
            assert 0 <= parsed.span.start <= parsed.span.end <= len(parsed.span.source.text)
            assert parsed.span.place().line >= 1


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("<a>x & y</a>", ["1:6"]),
        ("<a b='x&y;'>&foo &amp; &#65;</a>", ["1:8", "1:13"]),
        ("<a b='x<y>' c='1'/>", ["1:5"]),
        ("<a><!-- & --><![CDATA[&]]>&</a>", ["1:27"]),
        ("<a>\xe9\x01</a>", ["1:5"]),
        ("<a/>\n<b/>", ["2:1"]),
    ],
)
def test_what_gazebo_forgives_is_told_in_its_files(text: str, places: list[str]) -> None:
    """tinyxml2 9.0 loads each of these."""
    document = parse_xml(SourceText("model.sdf", text))
    assert isinstance(document, XmlDocument)
    assert [str(each.span.place()).partition(":")[2] for each in document.tolerated] == places


@pytest.mark.parametrize("text", ["<a/>junk", "<a/>\n<b>", "<a/><b/>junk", "<a b=1/>", "<a>&</b>"])
def test_what_gazebo_refuses_is_a_fault_in_its_files(text: str) -> None:
    """tinyxml2 9.0 refuses each of these."""
    assert isinstance(parse_xml(SourceText("model.sdf", text)), XmlFault)


def test_pluginlib_reads_angle_brackets_in_values_and_roslaunch_does_not() -> None:
    """pluginlib parses with tinyxml2, roslaunch with expat."""
    text = '<{0}><class type="arm::Cached<arm::Solver>"/></{0}>'
    plugins = parse_xml(SourceText("plugins.xml", text.format("library")))
    assert isinstance(plugins, XmlDocument)
    assert plugins.tolerated
    assert isinstance(parse_xml(SourceText("a.launch", text.format("launch"))), XmlFault)
