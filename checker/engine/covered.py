"""One fault, one finding: what a rule leaves to a more precise one that reports the same part."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from checker.base.record import Record
from checker.finding import Place, Severity
from checker.rule import Finding, Rule

SeverityOf = Callable[[Rule, Finding], Severity]
Said = tuple[Rule, list[Finding]]
"""A rule and what it found."""


class Parted(Record):
    """What a rule found.

    Attributes:
        told: What it reports.
        covered: What a more precise rule reports.
    """

    rule: Rule
    told: list[Finding]
    covered: list[Finding]


def parted_by_cover(said: Sequence[Said], severity_of: SeverityOf) -> list[Parted]:
    """Part findings from those that a rule of `covered_by` tells as gravely or more.

    It tells the same if it reports the same place; or all related places, which are what a finding
    suspects, or something in them.

    Args:
        said: What all rules found that ran.
        severity_of: Tells how grave a finding of a rule is.
    """
    covering = {id for _, found in said for finding in found for id in finding.covered_by}
    places: dict[str, list[tuple[int, tuple[Place, ...]]]] = {}
    for rule, found in said:
        if rule.id in covering:
            places[rule.id] = [(severity_of(rule, each).rank, each.places) for each in found]

    def is_covered(rule: Rule, finding: Finding) -> bool:
        own = severity_of(rule, finding).rank
        return any(
            _tells([at for rank, at in places.get(other, ()) if rank <= own], finding)
            for other in finding.covered_by
        )

    parted = []
    for rule, found in said:
        halves: tuple[list[Finding], list[Finding]] = ([], [])
        for each in found:
            halves[is_covered(rule, each)].append(each)
        parted.append(Parted(rule, *halves))
    return parted


def _tells(told: Sequence[tuple[Place, ...]], finding: Finding) -> bool:
    """Say whether places of findings, the main one first, are those of another finding."""
    main, *suspects = finding.places
    if any(_same(at[0], main) for at in told):
        return True
    known = [place for at in told for place in at]
    return bool(suspects) and all(
        any(_within(place, suspect) for place in known) for suspect in suspects
    )


def _same(one: Place, other: Place) -> bool:
    return (one.file, one.line, one.element) == (other.file, other.line, other.element)


def _within(place: Place, part: Place) -> bool:
    """Say whether a place is an element or in it."""
    inside = place.element == part.element or place.element.startswith(f"{part.element}/")
    return bool(part.element) and place.file == part.file and inside
