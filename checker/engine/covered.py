"""One fault, one finding: what a rule leaves to a more precise one that reports the same part."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

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
    told = {rule.id: _Told() for rule, _ in said if rule.id in covering}
    for rule, found in said:
        if rule.id in told:
            for each in found:
                told[rule.id].add(each.places, severity_of(rule, each).rank)

    def is_covered(rule: Rule, finding: Finding) -> bool:
        own = severity_of(rule, finding).rank
        others = (told[other] for other in finding.covered_by if other in told)
        return any(other.tells(finding.places, own) for other in others)

    parted = []
    for rule, found in said:
        halves: tuple[list[Finding], list[Finding]] = ([], [])
        for each in found:
            halves[is_covered(rule, each)].append(each)
        parted.append(Parted(rule, *halves))
    return parted


class _Told:
    """Places that a rule reports, each with the rank of the gravest finding there."""

    def __init__(self) -> None:
        """Hold none yet."""
        self._main: dict[tuple[str, int, str], int] = {}
        self._around: dict[tuple[str, str], int] = {}

    def add(self, places: Sequence[Place], rank: int) -> None:
        """Add the places of a finding, the main one first."""
        main = _key(places[0])
        self._main[main] = min(rank, self._main.get(main, rank))
        for place in places:
            for element in _around(place.element):
                at = place.file, element
                self._around[at] = min(rank, self._around.get(at, rank))

    def tells(self, places: Sequence[Place], rank: int) -> bool:
        """Say whether findings of a rank, or graver ones, have the places of another finding."""
        main, *suspects = places
        if self._main.get(_key(main), rank + 1) <= rank:
            return True
        return bool(suspects) and all(
            bool(place.element) and self._around.get((place.file, place.element), rank + 1) <= rank
            for place in suspects
        )


def _key(place: Place) -> tuple[str, int, str]:
    return place.file, place.line, place.element


def _around(element: str) -> Iterator[str]:
    """Yield an element and those around it, by their paths."""
    yield element
    end = element.rfind("/")
    while end > 0:
        yield element[:end]
        end = element.rfind("/", 0, end)
