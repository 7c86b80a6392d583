"""One fault, one finding: what a rule leaves to a more precise one that reports the same part."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import itemgetter

from checker.base.record import Record
from checker.finding import Place, Severity
from checker.rule import Finding, Rule

SeverityOf = Callable[[Rule, Finding], Severity]
Said = tuple[Rule, list[Finding]]
"""A rule and what it found."""
Cover = tuple[str, Finding]
"""The id of a rule and what it says."""
_Ranked = tuple[int, Finding]


class Parted(Record):
    """What a rule found.

    Attributes:
        told: What it reports.
        covered: What a more precise rule reports, each with what that rule says.
    """

    rule: Rule
    told: list[Finding]
    covered: list[tuple[Finding, Cover]]


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
                told[rule.id].add(each, severity_of(rule, each).rank)

    def cover_of(rule: Rule, finding: Finding) -> Cover | None:
        own = severity_of(rule, finding).rank
        others = (id for id in finding.covered_by if id in told)
        covers = ((id, told[id].telling(finding.places, own)) for id in others)
        return next(((id, cover) for id, cover in covers if cover), None)

    parted = []
    for rule, found in said:
        covers = [(each, cover_of(rule, each)) for each in found]
        parted.append(
            Parted(
                rule,
                [each for each, cover in covers if cover is None],
                [(each, cover) for each, cover in covers if cover is not None],
            )
        )
    return parted


class _Told:
    """Places that a rule reports, each with the gravest finding there and its rank."""

    def __init__(self) -> None:
        """Hold none yet."""
        self._main: dict[tuple[str, int, str], _Ranked] = {}
        self._around: dict[tuple[str, str], _Ranked] = {}

    def add(self, finding: Finding, rank: int) -> None:
        """Add the places of a finding, the main one first."""
        ranked = rank, finding
        main = _key(finding.places[0])
        self._main[main] = min(ranked, self._main.get(main, ranked), key=itemgetter(0))
        for place in finding.places:
            for element in _around(place.element):
                at = place.file, element
                self._around[at] = min(ranked, self._around.get(at, ranked), key=itemgetter(0))

    def telling(self, places: Sequence[Place], rank: int) -> Finding | None:
        """Return the finding of a rank, or a graver one, that has the places of another finding."""
        main, *suspects = places
        at_main = self._main.get(_key(main))
        if at_main and at_main[0] <= rank:
            return at_main[1]
        around = [
            self._around.get((place.file, place.element)) for place in suspects if place.element
        ]
        told = [cover[1] for cover in around if cover and cover[0] <= rank]
        return told[0] if told and len(told) == len(suspects) else None


def _key(place: Place) -> tuple[str, int, str]:
    return place.file, place.line, place.element


def _around(element: str) -> Iterator[str]:
    """Yield an element and those around it, by their paths."""
    yield element
    end = element.rfind("/")
    while end > 0:
        yield element[:end]
        end = element.rfind("/", 0, end)
