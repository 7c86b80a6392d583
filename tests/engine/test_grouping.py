"""One fault in many places is one finding, and it keeps its fingerprint."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.finding import Edit, Fix, Safety
from checker.rule import Finding, Severity, finding
from tests.engine.stage import at, fingerprints, rule_saying, run


def test_forty_repeats_are_one_finding_with_forty_places() -> None:
    repeats = [finding(at(line), "the same") for line in range(1, 41)]
    (found,) = run(rule_saying(*repeats)).findings
    assert [place.line for place in found.places] == list(range(1, 41))


def test_a_place_that_is_said_twice_is_shown_once() -> None:
    (found,) = run(rule_saying(finding(at(1), "x"), finding(at(1), "x"))).findings
    assert found.places == (at(1),)


def test_findings_with_one_key_are_one_though_their_messages_differ() -> None:
    rule = rule_saying(finding(at(1), "is 3", key="k"), finding(at(2), "is 4", key="k"))
    (found,) = run(rule).findings
    assert found.message == "is 3"
    assert len(found.places) == 2


def test_findings_of_different_severity_stay_apart() -> None:
    rule = rule_saying(finding(at(1), "x"), finding(at(2), "x", severity=Severity.INFO))
    assert len(run(rule).findings) == 2


def test_the_fixes_of_a_group_are_one_as_safe_as_the_least_safe() -> None:
    edits = [Edit(at(line), "1", "0") for line in (1, 2)]
    fixes = [Fix(Safety.SAFE, (edits[0],)), None, Fix(Safety.UNSAFE, (edits[1],))]
    rule = rule_saying(*(finding(at(n), "x", fix=fix) for n, fix in enumerate(fixes, 1)))
    (found,) = run(rule).findings
    assert found.fix == Fix(Safety.UNSAFE, tuple(edits))


def test_a_fingerprint_is_the_same_when_lines_move() -> None:
    assert fingerprints([finding(at(3, "link[a]"), "is 0.1")]) == fingerprints(
        [finding(at(300, "link[a]"), "is 0.1")]
    )


def test_a_fingerprint_in_an_element_is_the_same_when_the_value_changes() -> None:
    assert fingerprints([finding(at(3, "link[a]"), "is 0.1")]) == fingerprints(
        [finding(at(3, "link[a]"), "is 0.2")]
    )


def test_where_there_are_no_elements_mending_one_fault_leaves_the_others_theirs() -> None:
    two = fingerprints([finding(at(8), "launch/ is missing"), finding(at(8), "urdf/ is missing")])
    one = fingerprints([finding(at(5), "urdf/ is missing")])
    assert one == two[1:]


def test_fingerprints_differ_by_rule_file_element_and_key() -> None:
    assert len(set(fingerprints([
        finding(at(1, "link[a]"), "1", key="x"),
        finding(at(2, "link[a]"), "2", key="y"),
        finding(at(3, "link[b]"), "3", key="z"),
        finding(at(4, "link[a]", file="b.sdf"), "4"),
    ]))) == 4  # fmt: skip
    one, other = (run(rule_saying(finding(at(1), "x"), id=id)).findings[0] for id in ("A1", "A2"))
    assert one.fingerprint != other.fingerprint


_findings = st.builds(
    lambda line, element, message, key: finding(at(line, element), message, key=key),
    st.integers(1, 9),
    st.sampled_from(["", "link[a]", "link[b]"]),
    st.text(max_size=3),
    st.sampled_from(["", "k"]),
)


@given(st.lists(_findings, max_size=20), st.integers(1, 1000))
def test_fingerprints_are_distinct_and_do_not_depend_on_lines(found: list, moved: int) -> None:  # type: ignore[type-arg]  # of findings
    before = fingerprints(found)
    assert len(set(before)) == len(before)
    later = [
        finding(at(p.line + moved, p.element), each.message, key=each.key)
        for each in found
        for p in each.places
    ]
    assert fingerprints(later) == before


def test_a_message_of_half_a_surrogate_pair_has_a_fingerprint() -> None:
    assert fingerprints([finding(at(1), "\udcff")])


def test_each_place_of_a_group_says_what_is_wrong_there() -> None:
    first, again, other = (
        finding(at(line), message, key="colour")
        for line, message in ((1, "is 2"), (2, "is 2"), (3, "is 7"))
    )
    (found,) = run(rule_saying(first, again, other)).findings
    assert [place.message for place in found.places] == ["", "", "is 7"]


def missing(*names: str, line: int = 0) -> list[Finding]:
    places = (at(line or number) for number, _ in enumerate(names, 1))
    said = (f"{name!r} weighs {number} kg" for number, name in enumerate(names))
    return [finding(place, message) for place, message in zip(places, said, strict=True)]


def test_many_that_say_the_same_of_different_parts_are_one() -> None:
    (found,) = run(rule_saying(*missing("a", "b", "c", "d", "e"))).findings
    assert [place.message for place in found.places[1:3]] == ["'b' weighs 1 kg", "'c' weighs 2 kg"]
    assert len(found.places) == 5
    assert len(run(rule_saying(*missing("a", "b", "c"))).findings) == 3


def test_what_one_line_of_a_macro_makes_is_one_and_each_copy_is_named() -> None:
    copies = missing("left_wheel", "right_wheel", line=7)
    elements = [
        replace(copy, places=(replace(copy.places[0], element=f"link[{number}]"),))
        for number, copy in enumerate(copies)
    ]
    (found,) = run(rule_saying(*elements)).findings
    assert [place.message for place in found.places] == ["", "'right_wheel' weighs 1 kg"]
