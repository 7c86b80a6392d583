"""One fault, one finding: findings that a more precise rule reports for the same part."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter
from typing import TypeVar

from checker.base.record import Record
from checker.engine.judge import GradedFinding
from checker.finding import Place
from checker.rule import Rule

K = TypeVar("K")

Said = tuple[Rule, list[GradedFinding]]
"""A rule and what it found."""
Cover = tuple[str, GradedFinding]
"""The id of a rule and what it states."""


class SplitFindings(Record):
    """Findings of a rule, without and with those that a more precise rule reports.

    Attributes:
        reported: The findings that it reports.
        covered: The findings that repeat one of a more precise rule, each with that one.
    """

    rule: Rule
    reported: list[GradedFinding]
    covered: list[tuple[GradedFinding, Cover]]


def split_covered(said: Sequence[Said]) -> list[SplitFindings]:
    """Separate the findings that a rule of `covered_by` reports at no lower severity.

    A rule reports the same fault if it reports the same place; or all related places, which are
    what a finding suspects, or something in them.

    Args:
        said: What all rules found that ran.
    """
    covering = {id for _, found in said for finding in found for id in finding.covered_by}
    covering_places = {
        rule.id: _ReportedPlaces(found) for rule, found in said if rule.id in covering
    }

    def cover_of(finding: GradedFinding) -> Cover | None:
        others = (id for id in finding.covered_by if id in covering_places)
        covers = ((id, covering_places[id].cover(finding)) for id in others)
        return next(((id, cover) for id, cover in covers if cover), None)

    shares = []
    for rule, found in said:
        covers = [(each, cover_of(each)) for each in found]
        shares.append(
            SplitFindings(
                rule,
                [each for each, cover in covers if cover is None],
                [(each, cover) for each, cover in covers if cover is not None],
            )
        )
    return shares


class _ReportedPlaces:
    """Places that a rule reports, each with the most severe finding there."""

    def __init__(self, findings: Iterable[GradedFinding]) -> None:
        self._main: dict[tuple[str, int, str], GradedFinding] = {}
        self._around: dict[tuple[str, str], GradedFinding] = {}
        for finding in findings:
            _keep_worst(self._main, _key(finding.places[0]), finding)
            for place in finding.places:
                for element in _around(place.element):
                    _keep_worst(self._around, (place.file, element), finding)

    def cover(self, finding: GradedFinding) -> GradedFinding | None:
        """Return the finding, at least as severe, that has the places of another rule's."""
        main, *suspects = finding.places
        at_main = self._main.get(_key(main))
        if at_main and at_main.severity.rank <= finding.severity.rank:
            return at_main
        around = [
            self._around.get((place.file, place.element)) for place in suspects if place.element
        ]
        reported = [each for each in around if each and each.severity.rank <= finding.severity.rank]
        return reported[0] if reported and len(reported) == len(suspects) else None


def _keep_worst(kept: dict[K, GradedFinding], at: K, finding: GradedFinding) -> None:
    kept[at] = min(finding, kept.get(at, finding), key=attrgetter("severity.rank"))


def _key(place: Place) -> tuple[str, int, str]:
    return place.file, place.line, place.element


def _around(element: str) -> Iterator[str]:
    """Yield an element and those around it, by their paths."""
    yield element
    end = element.rfind("/")
    while end > 0:
        yield element[:end]
        end = element.rfind("/", 0, end)
