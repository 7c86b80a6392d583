"""Findings of now held against those of the baseline."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Hashable, Iterator, Sequence
from dataclasses import dataclass

from checker.fingerprint import bases_of
from checker.report.report import IN_BASELINE, ReportedFinding, Suppressed, SuppressedBy
from checker.suppression.baseline import BaselineEntry
from checker.suppression.parts import StaleEntries


@dataclass(frozen=True)
class Matched:
    """What a baseline comes to.

    Attributes:
        findings: Each with its entry; None for what is not in the baseline.
        stale: Entries without a finding.
    """

    findings: tuple[tuple[ReportedFinding, BaselineEntry | None], ...]
    stale: tuple[BaselineEntry, ...]

    @property
    def left(self) -> tuple[ReportedFinding, ...]:
        """Findings that are not in it."""
        return tuple(finding for finding, entry in self.findings if entry is None)

    @property
    def suppressed(self) -> tuple[Suppressed, ...]:
        """Findings that are, with the reason that the user gave, or ours."""
        return tuple(
            Suppressed(finding, SuppressedBy.BASELINE, entry.reason or IN_BASELINE)
            for finding, entry in self.findings
            if entry is not None
        )


def matched(findings: Sequence[ReportedFinding], entries: Sequence[BaselineEntry]) -> Matched:
    """Find the entry of each finding; an entry stands for one."""
    pairs = _pairs(findings, entries)
    taken = set(pairs.values())
    return Matched(
        tuple(
            (each, entries[pairs[at]] if at in pairs else None) for at, each in enumerate(findings)
        ),
        tuple(each for at, each in enumerate(entries) if at not in taken),
    )


def stale_by_rule(
    entries: Sequence[BaselineEntry], known: Collection[str], looked: Collection[str], file: str
) -> tuple[StaleEntries, ...]:
    """Return the stale entries of the rules that looked, or that exist no more."""
    messages: dict[str, list[str]] = {}
    for each in entries:
        if each.rule in looked or each.rule not in known:
            messages.setdefault(each.rule, []).append(each.message)
    return tuple(StaleEntries(rule, tuple(messages[rule]), file) for rule in sorted(messages))


_Items = Sequence[ReportedFinding] | Sequence[BaselineEntry]


def _pairs(findings: _Items, entries: _Items) -> dict[int, int]:
    """Return the number of the entry by the number of the finding."""
    pairs: dict[int, int] = {}
    for tell in _TELLS:
        taken = set(pairs.values())
        free: dict[Hashable, deque[int]] = {}
        for at, key in enumerate(tell(entries)):
            if at not in taken:
                free.setdefault(key, deque()).append(at)
        for at, key in enumerate(tell(findings)):
            if at not in pairs and free.get(key):
                pairs[at] = free[key].popleft()
    return pairs


def _exactly(items: _Items) -> Iterator[Hashable]:
    return zip(_bases(items), (each.message for each in items), strict=True)


def _by_words(items: _Items) -> Iterator[Hashable]:
    return ((each.rule, each.key or each.message) for each in items)


def _bases(items: _Items) -> Iterator[str]:
    return iter(bases_of([each.fingerprint for each in items]))


_TELLS: tuple[Callable[[_Items], Iterator[Hashable]], ...] = (_exactly, _by_words, _bases)
"""What makes a finding and an entry the same fault, the surest first.

Several places of a fault have the fingerprint of the first: when that is mended, the words still
tell. When a value changes, the words do, and the fingerprint tells. Equal faults are counted.
"""
