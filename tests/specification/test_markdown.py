"""Markdown: what shows as text, and where it stands in the file."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.markdown import PassageKind, read_markdown
from checker.source.text import SourceText
from tests.effort import large, limited

PIECES = st.lists(
    st.sampled_from(
        [
            "# a\n",
            "* b ",
            "  - c\n",
            "~~",
            "<!--",
            "-->",
            "```\n",
            "<sup>2</sup>",
            "\r\n",
            "`",
            "\n",
        ]
    )
).map("".join)


def passages(text: str):
    read = read_markdown(SourceText("specifications.md", text)).passages
    return [(each.kind.name, each.level, each.words) for each in read]


def test_blocks_become_passages_with_their_level():
    text = "# Title #\ntext\nof two lines\n\n* one\n  - two\n\n1. three\n\nSetext\n---\n"
    assert passages(text) == [
        ("HEADING", 1, "Title"),
        ("PARAGRAPH", 0, "text of two lines"),
        ("ITEM", 1, "one"),
        ("ITEM", 2, "two"),
        ("ITEM", 1, "three"),
        ("HEADING", 2, "Setext"),
    ]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a <!-- b\n\nc --> d", "a d"),
        ("a ~~b~~ c", "a c"),
        ("a <del>b</del> <s>c</s> d", "a d"),
        ("`gpu_lidar` plugin", "gpu_lidar plugin"),
        ("_x_ and **bold** of gpu_lidar", "x and bold of gpu_lidar"),
        ("m/s<sup>2</sup>", "m/s ^2"),
        ("m/(s*s)", "m/(s*s)"),
        ("[Links](#links) and https://x.org/1/2 end", "Links and end"),
        ("a &mdash; b", "a - b"),
    ],
)
def test_only_what_shows_counts(text, shown):
    assert " ".join(words for _, _, words in passages(text)) == shown


def test_anchors_in_headings_do_not_show():
    assert passages('# <a name="links"></a>Links') == [("HEADING", 1, "Links")]


def test_fences_hide_their_text_and_indented_lines_do_not():
    assert passages("```\n* 3 kg\n```\n\n    indented") == [("PARAGRAPH", 0, "indented")]


def test_a_passage_is_as_long_as_the_text_it_marks():
    source = SourceText("s.md", "\r\n* a `b` &mdash; c\r\n\r\n# D\r\n")
    first, second = read_markdown(source).passages
    assert first.span.text == "a `b` &mdash; c"
    assert first.part(first.text.index("b"), len(first.text)).text == "b` &mdash; c"
    assert second.kind is PassageKind.HEADING
    assert (second.span.line, second.span.text) == (4, "D")


@given(st.text(max_size=200) | PIECES)
def test_no_text_makes_the_reader_raise_and_every_passage_fits_its_span(text):
    for passage in read_markdown(SourceText("s.md", text)).passages:
        assert len(passage.text) == passage.span.end - passage.span.start
        assert 0 <= passage.span.start <= passage.span.end <= len(text)


@pytest.mark.slow
@pytest.mark.parametrize(
    "piece", ["<!--", "~~ ", "* ", "> ", "[", "](", "<a ", "# a\n", "`", "- a\n", "&mdash;"]
)
def test_long_monotonous_texts_take_little_time(piece):
    with limited(20):
        read_markdown(SourceText("s.md", piece * large(50_000)))
