"""Where a caret stands: in any text without failing, in well-formed ones as the parser says."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, strategies

from checker.editor.xml_context import Context, Where, tags_behind, xml_context
from checker.source.text import SourceText
from checker.source.xml import Element, XmlDocument, parse_xml
from tests.each import of_each
from tests.effort import limited

_PIECES = strategies.sampled_from(
    [
        *("<", ">", "/", "</", "/>", "=", '"', "'", " ", "\n", "<!--", "-->", "<![CDATA[", "]]>"),
        *("<?", "?>", "<!", "link", "a:b", 'name="x"', "<joint type='", "</link>", "<model>", "é"),
    ]
)
_NAMES = strategies.sampled_from(["link", "joint", "xacro:if", "a.b", "é"])
_TEXTS = strategies.sampled_from(
    ["", " ", "x > y", "\n  ", "<!-- <b> -->", "<![CDATA[<c d='>'>]]>", "<?p <e> ?>", "a\nb"]
)
_VALUES = strategies.sampled_from(["", "x", "a > b", "it's", "1 0 0", "/>"])


@strategies.composite
def _elements(draw: strategies.DrawFn, depth: int = 3) -> str:
    tag = draw(_NAMES)
    names = draw(strategies.lists(_NAMES, max_size=2, unique=True))
    stated = "".join(
        f'{draw(strategies.sampled_from([" ", "  "]))}{name}="{draw(_VALUES)}"' for name in names
    )
    inside = draw(_TEXTS)
    if depth:
        for _ in range(draw(strategies.integers(0, 2))):
            inside += draw(_elements(depth - 1)) + draw(_TEXTS)
    return f"<{tag}{stated}>{inside}</{tag}>" if inside else f"<{tag}{stated}/>"


@given(
    text=strategies.lists(_PIECES, max_size=40).map("".join), offset=strategies.integers(-2, 300)
)
def test_any_text_has_a_context(text: str, offset: int) -> None:
    context = xml_context(text, offset)
    at = min(max(offset, 0), len(text))
    assert 0 <= context.start <= at <= context.end <= len(text)
    assert context.typed == text[context.start : at]
    list(tags_behind(text, at))


@given(text=strategies.text(max_size=60), offset=strategies.integers(0, 60))
def test_any_characters_have_a_context(text: str, offset: int) -> None:
    assert xml_context(text, offset).where in Where


@given(text=_elements())
def test_a_document_is_read_as_the_parser_reads_it(text: str) -> None:
    text = f'<?xml version="1.0"?><sdf xmlns:xacro="u">{text}</sdf>'
    _agrees(parse_xml(SourceText("model.sdf", text)))


@pytest.mark.slow
def test_samples_are_read_as_the_parser_reads_them(samples: Path) -> None:
    path = samples / "husky_migration_sensor_config_1" / "model.sdf"
    _agrees(parse_xml(SourceText(path.name, path.read_text())), step=7)


def _agrees(document: object, step: int = 1) -> None:
    assert isinstance(document, XmlDocument)
    text = document.source.text
    for offset in range(0, len(text) + 1, step):
        context = xml_context(text, offset)
        around, inside = _around(document.elements, offset)
        assert context.tags == tuple(element.tag for element in around), offset
        _agrees_inside(context, inside, offset)


def _around(elements: list[Element], offset: int) -> tuple[list[Element], Element | None]:
    around: list[Element] = []
    inside = None
    for element in elements:
        at = element.position
        if at.start < offset < at.end:
            if offset < at.start_end:
                inside = element
            else:
                around.append(element)
    return around, inside


def _agrees_inside(context: Context, inside: Element | None, offset: int) -> None:
    assert (context.where in (Where.TAG, Where.ATTRIBUTE, Where.VALUE)) == (inside is not None)
    if inside is None:
        return
    assert context.tag == inside.tag
    name = inside.name_span
    assert (context.where is Where.TAG) == (name.start <= offset <= name.end)
    values = {name: inside.attribute(name) for name in inside.attributes}
    held = [
        name
        for name, value in values.items()
        if value is not None and value.span.start <= offset <= value.span.end
    ]
    if held:
        value = values[held[0]]
        assert value is not None
        assert context.where is Where.VALUE
        assert (context.attribute, context.start, context.end) == (
            held[0],
            value.span.start,
            value.span.end,
        )


@of_each(
    "case",
    [
        ("<sdf><model><|", Where.TAG, ("sdf", "model"), ""),
        ("<sdf><model><li|\n  <link name='a'>", Where.TAG, ("sdf", "model"), "li"),
        ("<sdf><model name='a'></|", Where.CLOSING, ("sdf", "model"), ""),
        ('<link><sensor type="|\n<topic>', Where.VALUE, ("link",), ""),
        ("<link><sensor type=|>", Where.VALUE, ("link",), ""),
        ("<link><sensor type=\"cam| name='a'>", Where.VALUE, ("link",), "cam"),
        ('<link><sensor type="|" name="x">', Where.VALUE, ("link",), ""),
        ("<link><sensor na|", Where.ATTRIBUTE, ("link",), "na"),
        ("<joint><parent>ba|\n</joint>", Where.TEXT, ("joint", "parent"), "ba"),
        ("<a><b></a><c>|", Where.TEXT, ("c",), ""),
        ("<a><b <c>|", Where.TEXT, ("a", "c"), ""),
        ("<a></b><c>|", Where.TEXT, ("a", "c"), ""),
        ("<a><!-- <b>|", Where.OTHER, ("a",), ""),
    ],
)
def test_a_text_being_typed_is_understood(
    case: tuple[str, Where, tuple[str, ...], str],
) -> None:
    marked, where, tags, typed = case
    offset = marked.index("|")
    context = xml_context(marked.replace("|", ""), offset)
    assert (context.where, context.tags, context.typed) == (where, tags, typed)


def test_a_value_without_its_end_swallows_no_other_attribute() -> None:
    text = '<sensor type="cam name="a">'
    context = xml_context(text, text.index("cam") + 3)
    assert (context.where, context.typed, text[context.start : context.end]) == (
        Where.VALUE,
        "cam",
        "cam",
    )


def test_elements_in_front_and_behind_are_known() -> None:
    text = "<model><link/><a><b/></a>  <joint><c/></joint><frame/></model><other/>"
    offset = text.index("  ") + 1
    context = xml_context(text, offset)
    assert context.innermost is not None
    assert context.innermost.children == ("link", "a")
    assert list(tags_behind(text, offset)) == ["joint", "frame"]


@pytest.mark.slow
@of_each("unit", ["<a ", "<a b='", "<!--", "</a", "<a><", "<a>", '<a "', "</x>"])
def test_hostile_texts_take_linear_time(unit: str) -> None:
    text = unit * (300_000 // len(unit))
    with limited(3.0):
        xml_context(text, len(text))
        list(tags_behind(text, 0))
