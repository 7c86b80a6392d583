"""What of the baseline is the same fault as one of now: place by place, and counted."""

from __future__ import annotations

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from checker.finding import Concern, Place, Severity
from checker.report.report import ReportedFinding
from checker.rulebook.suppression.baseline import BaselineEntry
from checker.rulebook.suppression.baseline_match import Held, Matched, match_entries
from checker.rulebook.suppression.finding_places import (
    NAME_LIMIT,
    Spot,
    place_name,
    spot,
    spots_of,
)

ERROR, WARNING, INFO = Severity


def at(element: str, message: str, severity: Severity = ERROR, key: str = "") -> Spot:
    return spot("KIN001", severity, Place("model.sdf", element=element), key, message)


def in_file(message: str, snippet: str = "", key: str = "") -> Spot:
    return spot("ROS001", ERROR, Place("a.yaml", snippet=snippet), key, message)


def entries(*before: Spot) -> list[BaselineEntry]:
    """Return an entry for the places of each fault."""
    faults: dict[tuple[str, Severity, str, str], list[str]] = {}
    for each in before:
        words = each.key or each.message
        faults.setdefault((each.rule, each.severity, each.key, words), []).append(each.place)
    return [
        BaselineEntry(rule, severity, words, dict(Counter(places)), key)
        for (rule, severity, key, words), places in faults.items()
    ]


def held(now: list[Spot], before: list[Spot]) -> Matched:
    return match_entries(now, entries(*before))


def new(now: list[Spot], before: list[Spot]) -> list[str]:
    found = held(now, before).entries
    return [each.message for each, entry in zip(now, found, strict=True) if entry is None]


_spots = st.lists(
    st.builds(
        at,
        st.sampled_from(["", "a", "b"]),
        st.sampled_from("xyz"),
        st.sampled_from(Severity),
        st.sampled_from(["", "k"]),
    ),
    max_size=12,
)


@given(_spots)
def test_what_did_not_change_is_in_the_baseline(said: list[Spot]) -> None:
    assert new(said, said) == []
    assert held(said, said).stale == ()


@given(_spots, _spots)
def test_no_place_is_taken_twice_nor_by_what_is_graver(now: list[Spot], before: list[Spot]) -> None:
    known = entries(*before)
    found = match_entries(now, known)
    taken = [
        (entry, each.place)
        for each, entry in zip(now, found.entries, strict=True)
        if entry is not None
    ]
    for (entry, place), number in Counter(taken).items():
        assert number <= known[entry].places[place]
    for each, at_entry in zip(now, found.entries, strict=True):
        assert at_entry is None or known[at_entry].severity.rank <= each.severity.rank
    assert {entry for entry, _ in taken}.isdisjoint(found.stale)


@given(_spots, st.integers(0, 11))
def test_mending_one_leaves_nothing_new(said: list[Spot], mended: int) -> None:
    assert new(said[:mended] + said[mended + 1 :], said) == []


@given(_spots, _spots)
def test_what_stands_in_new_elements_is_new(said: list[Spot], before: list[Spot]) -> None:
    more = [at("elsewhere", each.message, each.severity, each.key) for each in said]
    assert len(new([*before, *more], before)) == len(more)


def test_of_equals_the_new_one_is_reported() -> None:
    before = [at("a", "first"), at("a", "second")]
    assert new([at("a", "new"), *before], before) == ["new"]
    assert new([at("a", "first"), at("a", "first")], [at("a", "first")]) == ["first"]


def test_a_value_may_change_in_its_element() -> None:
    assert new([at("a", "mass is 2")], [at("a", "mass is 1")]) == []
    assert new([in_file("rate is 2")], [in_file("rate is 1")]) == ["rate is 2"]


def test_lines_may_move() -> None:
    assert new([in_file("repeats line 12")], [in_file("repeats line 7")]) == []


def test_the_words_of_a_line_tell_places_without_elements() -> None:
    before = [in_file("one", "gain:  1", "k"), in_file("two", "gain: 2", "k")]
    assert new([in_file("two", "gain: 2", "k")], before) == []
    assert new([in_file("three", "gain: 3", "k")], before) == ["three"]


def test_what_is_graver_is_new_and_not_gone() -> None:
    now, before = [at("a", "x", ERROR)], [at("a", "x", WARNING)]
    assert (new(now, before), held(now, before).stale) == (["x"], ())
    assert new([at("a", "x", INFO)], before) == []
    both = [at("a", "x", ERROR), at("a", "x", WARNING)]
    assert held(both, before).entries == (None, 0)


def test_an_entry_is_stale_when_nothing_of_it_is_left() -> None:
    before = [at("a", "x"), at("b", "x"), at("c", "y")]
    assert held([at("b", "x")], before).stale == (1,)
    assert held([], before).stale == (0, 1)


def test_stale_entries_are_those_of_rules_that_looked_or_do_not_exist() -> None:
    rules = ("KIN001", "KIN001", "KIN002", "OLD001", "OLD002")
    old = Held(BaselineEntry(rule, ERROR, f"m{rule[-1]}", {"a": 1}) for rule in rules)
    assert old.entries_of("KIN001", []) == []
    said = old.stale({"KIN001", "KIN002"}, {"KIN001"}, "b.json")
    assert [(each.rules, each.messages, each.known) for each in said] == [
        (("KIN001",), ("m1", "m1"), True),
        (("OLD001", "OLD002"), ("m1", "m2"), False),
    ]


def test_related_places_are_no_places_of_the_fault() -> None:
    places = (Place("a"), Place("b", note="first named here"), Place("c"))
    fault = ReportedFinding("KIN001", "name", ERROR, Concern.ROBOT, "m", "0", places)
    assert [each.place for each in spots_of(fault)] == ["a", "c"]


def test_places_are_named_by_file_and_element() -> None:
    assert place_name(Place(""), "") == "."
    assert place_name(Place("a", 7, snippet="x"), "") == "a"
    assert place_name(Place("a", 7, snippet="  x \t y"), "k") == "a: x y"
    assert place_name(Place("a#b: %", element="sdf/model[a]"), "") == "a%23b%3A %25#sdf/model[a]"


@given(st.text(min_size=NAME_LIMIT), st.text(min_size=NAME_LIMIT))
def test_long_names_stay_different(one: str, other: str) -> None:
    names = [place_name(Place("a", element=text), "") for text in (one, other)]
    assert all(len(name) <= NAME_LIMIT for name in names)
    assert (names[0] == names[1]) == (one == other)
