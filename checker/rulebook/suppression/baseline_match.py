"""Current findings compared with those of the baseline, place by place."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Sequence

from checker.base.record import Record
from checker.finding import Severity
from checker.rulebook.suppression.baseline import BaselineEntry
from checker.rulebook.suppression.finding_places import Spot, by_element, by_words
from checker.rulebook.suppression.parts import StaleEntries

_Tell = Callable[[str, str, str, str], Hashable]
_TELLS: tuple[_Tell, ...] = (by_words, by_element)
"""Comparisons of a current place with an entry of the baseline, the most certain first."""


class Matched(Record):
    """Result of the comparison with a baseline.

    Attributes:
        entries: The number of each spot's entry; None for what is not in the baseline.
        stale: Numbers of the entries of which nothing is left.
    """

    entries: tuple[int | None, ...]
    stale: tuple[int, ...]


def match_entries(spots: Sequence[Spot], entries: Sequence[BaselineEntry]) -> Matched:
    """Find the entry of each spot.

    An entry represents as many spots of a place as it counts there, and none that is more severe
    than it was.
    """
    left = [dict(entry.places) for entry in entries]
    taken: dict[int, int] = {}
    for tell in _TELLS:
        free = _free(entries, left, tell)
        for at, spot in enumerate(spots):
            entry = None if at in taken else _take(spot, free, left, tell)
            if entry is not None:
                taken[at] = entry
    used = set(taken.values())
    # What is left at a place of an unused entry is more severe than that: the fault is not gone.
    left_over = [spot for at, spot in enumerate(spots) if at not in taken]
    graver = {_key_of(tell, spot) for spot in left_over for tell in _TELLS}
    unused = (at for at in range(len(entries)) if at not in used)
    stale = tuple(at for at in unused if graver.isdisjoint(_tales(entries[at])))
    return Matched(tuple(map(taken.get, range(len(spots)))), stale)


_Free = dict[tuple[Severity, Hashable], deque[int]]
"""Numbers of entries that may have something left, by what identifies them."""


def _free(entries: Sequence[BaselineEntry], left: Sequence[dict[str, int]], tell: _Tell) -> _Free:
    free: _Free = {}
    for at, entry in enumerate(entries):
        for place, number in left[at].items():
            key = tell(entry.rule, place, entry.key, entry.message)
            if number and key is not None:
                free.setdefault((entry.severity, key), deque()).append(at)
    return free


def _take(spot: Spot, free: _Free, left: Sequence[dict[str, int]], tell: _Tell) -> int | None:
    """Take a place of an entry that is as severe as the spot, else of a more severe one."""
    for severity in list(Severity)[spot.severity.rank :: -1]:
        waiting = free.get((severity, _key_of(tell, spot)))
        while waiting:
            entry = waiting[0]
            if left[entry][spot.place] > 0:
                left[entry][spot.place] -= 1
                return entry
            waiting.popleft()
    return None


def _key_of(tell: _Tell, spot: Spot) -> Hashable:
    return tell(spot.rule, spot.place, spot.key, spot.message)


def _tales(entry: BaselineEntry) -> Iterator[Hashable]:
    for place in entry.places:
        keys = (tell(entry.rule, place, entry.key, entry.message) for tell in _TELLS)
        yield from (entry for entry in keys if entry is not None)


class Held:
    """Entries of the baseline for one package, taken rule by rule."""

    def __init__(self, entries: Iterable[BaselineEntry]) -> None:
        self._entries: dict[str, list[BaselineEntry]] = {}
        for entry in entries:
            self._entries.setdefault(entry.rule, []).append(entry)
        self._stale = dict(self._entries)

    def knows(self, rule: str) -> bool:
        """Return whether the baseline has findings of a rule."""
        return rule in self._entries

    def entries_of(self, rule: str, spots: Sequence[Spot]) -> list[BaselineEntry | None]:
        """Return the entry of each spot that a rule finds; None for what is new."""
        entries = self._entries.get(rule, [])
        match = match_entries(spots, entries)
        self._stale[rule] = [entries[at] for at in match.stale]
        return [None if at is None else entries[at] for at in match.entries]

    def stale(
        self, known: Collection[str], looked: Collection[str], file: str
    ) -> tuple[StaleEntries, ...]:
        """Return what is gone: of rules that looked, one by one; then of rules that do not exist.

        Args:
            known: Ids of all rules.
            looked: Ids of those that ran on complete data.
            file: What to call the baseline's file.
        """
        gone = {rule: tuple(entry.message for entry in self._stale[rule]) for rule in self._stale}
        of_rules = [
            StaleEntries((rule,), gone[rule], file)
            for rule in sorted(gone)
            if gone[rule] and rule in looked and rule in known
        ]
        unknown = tuple(sorted(rule for rule in gone if rule not in known))
        messages = tuple(message for rule in unknown for message in gone[rule])
        others = [StaleEntries(unknown, messages, file, known=False)] if unknown else []
        return (*of_rules, *others)
