"""How comments that set findings aside are read."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.rulebook.suppression.comments import (
    COMMENTS_LIMIT,
    NAMES_LIMIT,
    Comment,
    comments_of,
)
from checker.rulebook.suppression.entries import REASON_LIMIT
from checker.source.text import SourceText


def comments(text: str, file: str = "model.sdf") -> tuple[Comment, ...]:
    return comments_of(SourceText(file, text))


def only(text: str, file: str = "model.sdf") -> Comment:
    (comment,) = comments(text, file)
    return comment


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("model.sdf", "<a/> <!-- subt-check: ignore[SEN005] as built -->"),
        ("model.sdf", "<!--subt-check:ignore [ SEN005 ]as  built-->"),
        ("model.sdf", "<!-- subt-check: ignore[SEN005] as\n     built -->"),
        ("model.sdf", "<!--\n  subt-check: ignore[SEN005] as built\n-->"),
        ("model.sdf", "<!-- Subt-Check : Ignore[SEN005] as built -->"),
        ("specifications.md", "15 Hz <!-- subt-check: ignore[SEN005] as built -->"),
        ("launch/spawner.rb", "x = 1 # subt-check: ignore[SEN005] as built"),
        ("launch/spawner.rb", "  <a/> <!-- subt-check: ignore[SEN005] as built -->"),
        ("CMakeLists.txt", "#subt-check: ignore[SEN005] as built\r\n"),
        ("config/a.yaml", "a: 1 # subt-check: ignore[SEN005] as built\nb: 2\n"),
    ],
)
def test_names_and_reason_are_read(file: str, text: str) -> None:
    comment = only(text, file)
    assert (comment.names, comment.reason) == (("SEN005",), "as built")
    assert comment.place.line == 1


def test_several_rules_may_be_named() -> None:
    comment = only("<!-- subt-check: ignore[SEN005, imprecise-angle,,SEN005] as built -->")
    assert comment.names == ("SEN005", "imprecise-angle")


@pytest.mark.parametrize("text", ["", "-", " … "])
def test_a_reason_has_a_word(text: str) -> None:
    assert only(f"<!-- subt-check: ignore[SEN005]{text}-->").reason == ""


@pytest.mark.parametrize(
    "text", ["ignore SEN005 as built", "ignore[] x", "off[SEN005] x", "ignore"]
)
def test_another_form_names_no_rule(text: str) -> None:
    comment = only(f"<!-- subt-check: {text} -->")
    assert (comment.names, comment.fault) == ((), "it contains no ignore[RULE]")


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("model.sdf", "<!-- subt-check ignore[SEN005] as built -->"),
        ("model.sdf", "<!--\nsubt-check\nignore [SEN005] as built -->"),
        ("a.rb", "x = 1 # SUBT-CHECK ignore[SEN005]"),
    ],
)
def test_a_mark_without_its_colon_is_at_fault(file: str, text: str) -> None:
    comment = only(text, file)
    assert (comment.names, comment.fault) == ((), "a colon is missing after subt-check")


def test_a_mark_in_its_form_is_without_fault() -> None:
    assert only("<!-- subt-check: ignore[SEN005] as built -->").fault == ""


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("model.sdf", "<!-- subt-check: looked at this -->"),
        ("model.sdf", "<!-- subt-check: -->"),
        ("model.sdf", "<!-- subt-check ignores[1] this -->"),
        ("model.sdf", "<!-- subt-check can ignore[SEN005] by a comment -->"),
        ("model.sdf", "<!-- subt-check: ignore[SEN005] never closed"),
        ("model.sdf", "# subt-check: ignore[SEN005] no comment in XML"),
        ("README.md", "# subt-check: ignore[SEN005] a title"),
        ("a.rb", "'subt-check: ignore[SEN005] no comment'"),
    ],
)
def test_what_is_none(file: str, text: str) -> None:
    assert comments(text, file) == ()


def test_beside_a_text_it_is_about_that_line_alone() -> None:
    assert only("\n<a/> <!-- subt-check: ignore[A] x -->\n<b/>").lines == (2,)
    assert only("\nx = 1 # subt-check: ignore[A] x\ny", "a.rb").lines == (2,)


def test_alone_on_its_line_it_is_about_the_line_below() -> None:
    assert only("\n  <!-- subt-check: ignore[A] x -->\r\n<b/>").lines == (2, 3)
    assert only("\n\t# subt-check: ignore[A] x\ny", "a.rb").lines == (2, 3)
    assert only("<!-- subt-check: ignore[A]\nx\n-->  <!-- y -->\n<b/>").lines == (1, 3, 4)


def test_stacked_ones_are_about_the_line_below_the_last() -> None:
    text = "<!-- subt-check: ignore[A] x -->\n<!-- subt-check: ignore[B]\n x -->\n<b/>"
    assert [each.lines for each in comments(text)] == [(1, 4), (2, 3, 4)]
    text = "# subt-check: ignore[A] x\n# subt-check: ignore[B] x\ny"
    assert [each.lines for each in comments(text, "a.rb")] == [(1, 3), (2, 3)]


_words = st.text(
    st.characters(exclude_characters="[]-,\n\r", exclude_categories=["Cs"]), max_size=9
)


@given(_words, _words, st.sampled_from(["a.sdf", "a.rb"]))
def test_what_is_written_is_read(name: str, reason: str, file: str) -> None:
    (comment,) = comments(f"<a/> <!-- subt-check: ignore[{name}] {reason} -->", file)[:1]
    assert comment.names == tuple(filter(None, [name.strip()]))
    expected = " ".join(reason.split()) if re.search(r"\w", reason) else ""
    assert comment.reason == expected


_pieces = st.sampled_from(
    ["<!--", "-->", "#", "subt-check", ":", "ignore[", "A]", " ", "\n", "\r", "é"]
)


@given(
    st.lists(_pieces, max_size=60).map("".join), st.sampled_from([".sdf", ".md", ".rb", ".yaml"])
)
def test_any_text_is_read_with_places_within_it(text: str, suffix: str) -> None:
    source = SourceText(f"a.{suffix}", text)
    for comment in comments_of(source):
        assert source.offset_of(comment.place.line, comment.place.column) is not None
        assert comment.place.line in comment.lines
        assert comment.lines == tuple(sorted(set(comment.lines)))


@pytest.mark.parametrize(
    "text",
    [
        "<!-- subt-check: ignore[A] x -->" * 50_000,
        "<!-- subt-check: ignore[A] x\n" * 50_000,
        ("<!--" + " " * 300) * 10_000 + "subt-check",
        "<!-- subt-check" + " " * 1_000_000 + "ignore[A] x -->",
        "<!--" * 200_000 + "subt-check: ignore[A] x -->",
        "# subt-check: ignore[" + "A," * 500_000 + "] x",
        "# subt-check: ignore" + " " * 1_000_000,
        "# subt-check: ignore[A] x\n" * 50_000,
    ],
)
def test_what_is_read_is_bounded(text: str) -> None:
    found = comments(text, "a.rb")
    assert len(found) <= COMMENTS_LIMIT
    assert all(
        len(each.names) <= NAMES_LIMIT and len(each.reason) <= REASON_LIMIT for each in found
    )
