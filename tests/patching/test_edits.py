"""Edits of a text: which go together, and what comes of them."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from checker.finding import Edit, Fix, Place, Safety
from checker.fix.rounds import EditedText, Stretch, take
from checker.source.text import SourceText, Span

TEXTS = st.text(st.sampled_from("ab \n\r\té🤖"), max_size=60)


def edited(text: str) -> EditedText:
    return EditedText(SourceText("model.sdf", text))


def fix(text: EditedText, *changes: tuple[int, int, str]) -> Fix:
    edits = (Span(text.source, start, end).replacement(new) for start, end, new in changes)
    return Fix(Safety.SAFE, tuple(edits))


@given(TEXTS, st.data())
def test_an_edit_reaches_its_own_characters(text: str, data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, len(text)))
    one = edited(text)
    assert take(fix(one, (start, end, "NEW")), {"model.sdf": one})
    assert one.result == text[:start] + "NEW" + text[end:]


@given(TEXTS, st.data())
def test_many_edits_give_what_they_give_one_by_one_from_the_back(
    text: str, data: st.DataObject
) -> None:
    numbers = st.integers(0, len(text))
    cuts = sorted(data.draw(st.sets(numbers, min_size=0, max_size=8)))
    pairs = list(zip(cuts[::2], cuts[1::2], strict=False))
    one, expected = edited(text), text
    for number, (start, end) in enumerate(pairs):
        assert take(fix(one, (start, end, str(number))), {"model.sdf": one})
    for number, (start, end) in reversed(list(enumerate(pairs))):
        expected = expected[:start] + str(number) + expected[end:]
    assert one.result == expected


def test_of_two_fixes_that_overlap_the_first_is_made() -> None:
    one = edited("<pose>0 0 0</pose>")
    assert take(fix(one, (6, 11, "1 1 1")), {"model.sdf": one})
    assert not take(fix(one, (8, 9, "2")), {"model.sdf": one})
    assert one.result == "<pose>1 1 1</pose>"


def test_two_insertions_at_one_point_wait_for_each_other() -> None:
    one = edited("ab")
    assert take(fix(one, (1, 1, "x")), {"model.sdf": one})
    assert not take(fix(one, (1, 1, "y")), {"model.sdf": one})


def test_the_same_edit_of_two_findings_is_made_once() -> None:
    one = edited("ab")
    assert take(fix(one, (0, 1, "x")), {"model.sdf": one})
    assert take(fix(one, (0, 1, "x")), {"model.sdf": one})
    assert one.result == "xb"


def test_a_fix_is_made_whole_or_not_at_all() -> None:
    one = edited("abcdef")
    assert take(fix(one, (4, 5, "E")), {"model.sdf": one})
    assert not take(fix(one, (0, 1, "A"), (4, 6, "X")), {"model.sdf": one})
    assert not take(fix(one, (0, 2, "A"), (1, 3, "B")), {"model.sdf": one})
    assert one.result == "abcdEf"


def test_an_edit_of_text_that_is_not_there_is_not_made() -> None:
    one = edited("#{_name}")
    computed = Edit(Place("model.sdf", 1, 1, 1, 9), "x", original="rover")
    outside = Edit(Place("model.sdf", 7, 1, 7, 3), "x", original="")
    for edit in (computed, outside):
        assert not take(Fix(Safety.SAFE, (edit,)), {"model.sdf": one})


def test_stretches_that_touch_do_not_collide() -> None:
    assert not Stretch(0, 2, "").collides(Stretch(2, 4, ""))
    assert Stretch(0, 3, "").collides(Stretch(2, 4, ""))


@given(st.lists(st.tuples(st.integers(0, 30), st.integers(0, 4), st.sampled_from("ab"))))
def test_what_is_accepted_collides_with_nothing(wanted: list[tuple[int, int, str]]) -> None:
    text = EditedText(SourceText("a.sdf", "x" * 40))
    taken: list[Stretch] = []
    for start, length, replacement in wanted:
        stretch = Stretch(start, start + length, replacement)
        free = all(stretch == each or not stretch.collides(each) for each in taken)
        assert text.accepts(stretch) == free
        if free:
            text.add(stretch)
            taken += [] if stretch in taken else [stretch]
    assert text.stretches == sorted(taken)
