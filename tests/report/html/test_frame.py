"""The line of source beside a finding, and what a fix makes of it."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from checker.base.words import plain
from checker.finding import Edit, Fix, Place, Safety
from checker.report.html.findings import WIDTH, changes_of, frame_of


def place(snippet: str, column: int, end_column: int, end_line: int = 7) -> Place:
    return Place("model.sdf", 7, column, end_line, end_column, snippet=snippet)


def test_the_indent_is_left_out() -> None:
    frame = frame_of(place("      <mass>0</mass>", 13, 14))
    assert frame is not None
    assert (frame.before, frame.marked, frame.after) == ("<mass>", "0", "</mass>")


def test_what_goes_on_in_further_lines_is_marked_to_the_end() -> None:
    frame = frame_of(place("  <link name='a'", 3, 9, end_line=9))
    assert frame is not None
    assert (frame.before, frame.marked, frame.after) == ("", "<link name='a'", "")


def test_a_blank_line_has_no_frame() -> None:
    assert frame_of(place("   ", 1, 2)) is None
    assert frame_of(Place("model.sdf")) is None


@given(st.text(max_size=1500), st.integers(1, 1600), st.integers(0, 1600))
def test_a_frame_is_bounded_and_steers_nothing(text: str, column: int, length: int) -> None:
    frame = frame_of(place(text, column, column + length))
    if frame is None:
        return
    shown = frame.before + frame.marked + frame.after
    assert len(shown) < 3 * WIDTH
    assert plain(shown) == shown
    assert shown.replace("…", "") == shown or len(text) > 100 or "…" in text


def test_an_edit_within_a_line_shows_the_line() -> None:
    line = "      <mass>0</mass>"
    edit = Edit(place(line, 13, 14), "1.5", "0")
    (change,) = changes_of(Fix(Safety.SAFE, (edit,)))
    assert (change.removed, change.added) == (("<mass>0</mass>",), ("<mass>1.5</mass>",))


def test_an_insertion_of_lines_shows_what_is_added() -> None:
    edit = Edit(Place("model.sdf", 3, 1, 3, 1), "<a/>\n<b/>\n", "")
    (change,) = changes_of(Fix(Safety.SAFE, (edit,)))
    assert change.removed == ()
    assert change.added[:2] == ("<a/>", "<b/>")


def test_a_long_patch_is_cut() -> None:
    edit = Edit(Place("model.sdf", 3, 1, 3, 1), "<a/>\n" * 5000, "")
    changes = list(changes_of(Fix(Safety.SAFE, (edit,) * 5000)))
    assert len(changes) < 100
    assert "more lines" in changes[0].added[-1]
