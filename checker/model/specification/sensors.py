"""The sensors that a sheet lists: what kind, how many, for which configuration.

`modeled by 4 camera plugins` counts more than the device in front of it. A number is given only
where the item spells it out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record
from checker.model.specification.quantities import WORDS, configurations_in, number_of
from checker.model.specification.sensor_kinds import SensorKind, kinds_in
from checker.source.markdown import Passage, PassageKind
from checker.source.text import Span

_NUMBER = rf"(\d{{1,2}}|{'|'.join(WORDS)})"
_LEADING = re.compile(rf"{_NUMBER}\s?(?:[x×](?=\s|\w)|\s(?=[a-z]))", re.IGNORECASE)
_ONE = re.compile(r"an?\s", re.IGNORECASE)
_TIMES = re.compile(r"\([x×]\s?(\d{1,2})\)|\((\d{1,2})\s?[x×]\)", re.IGNORECASE)
_MODELED = re.compile(r"\bmodell?ed\s+(?:by|using|as|with|through|via)\b", re.IGNORECASE)
NOT_MODELED = re.compile(
    r"\bnot\s+(?:yet\s+)?(?:modell?ed|simulated|included)\b|\bthere\s+is\s+not?\b", re.IGNORECASE
)
_ACTUATOR = re.compile(r"\bjoint|\bcontroller", re.IGNORECASE)
_MODEL_COUNT = re.compile(rf"\s+(?:the\s+)?{_NUMBER}\s", re.IGNORECASE)
_CLAUSE_END = re.compile(r"[.(;]\s*")
_BREADCRUMBS = re.compile(rf"\b{_NUMBER}\s+(?:communications?\s+)?breadcrumbs\b", re.IGNORECASE)
_VAGUE = re.compile(r"\b(?:dual|stereo|quad|triple|pairs?|several|multiple|set|array|head)\b", re.I)


class ListedSensor(Record, eq=False):
    """One kind of sensor of one item of the list.

    Attributes:
        kind: What it is.
        count: The number; None if the item does not state it clearly.
        modeled: Whether the item states which plugin or sensor of the model represents it.
        configurations: Sensor configurations that the item or the words above its list name;
            empty if it is meant for all that the sheet describes.
        text: The item.
        span: The item.
    """

    kind: SensorKind
    count: int | None
    modeled: bool
    configurations: frozenset[int]
    text: str
    span: Span


def listed_sensors(passages: Sequence[Passage]) -> Iterator[ListedSensor]:
    """Yield what the lists of a section name."""
    lead: frozenset[int] = frozenset()
    for index, passage in enumerate(passages):
        if passage.kind is not PassageKind.ITEM:
            lead = configurations_in(passage.words)
            yield from _breadcrumbs(passage)
        elif NOT_MODELED.search(passage.text) is None:
            yield from _read_item(passage, _children(passages, index), lead)


def _breadcrumbs(passage: Passage) -> Iterator[ListedSensor]:
    """Yield what lines such as `Sensor Config 2 adds 12 breadcrumbs:` state outside of lists."""
    for line in re.finditer(r".+", passage.text):
        match = _BREADCRUMBS.search(line.group())
        if match:
            yield ListedSensor(
                SensorKind.BREADCRUMBS,
                int(number_of(match.group(1))),
                modeled=False,
                configurations=configurations_in(line.group()),
                text=" ".join(line.group().split()),
                span=passage.part(line.start() + match.start(), line.start() + match.end()),
            )


def _children(passages: Sequence[Passage], index: int) -> list[Passage]:
    """Return the items one level below an item."""
    below = []
    for passage in passages[index + 1 :]:
        if passage.kind is not PassageKind.ITEM or passage.level <= passages[index].level:
            break
        below.append(passage)
    return below


def _read_item(
    item: Passage, below: Iterable[Passage], lead: frozenset[int]
) -> Iterator[ListedSensor]:
    words = item.words
    modeled = _MODELED.search(words)
    kinds = kinds_in(words, words)
    count = _count(words, below)
    if modeled:
        clause = _CLAUSE_END.split(words[modeled.end() :], maxsplit=1)[0]
        kinds = kinds_in(clause, words) or (() if _ACTUATOR.search(clause) else kinds)
        stated = _MODEL_COUNT.match(clause)
        if stated:
            count = int(number_of(stated.group(1)))
    elif item.level > 1:
        # Remarks about the sensor above; its number was taken from them there.
        return
    elif len(kinds) > 1:
        # Without `modeled by` the first word says what the item is, the others are asides.
        kinds, count = kinds[:1], None
    configurations = configurations_in(words) or lead
    for kind in kinds:
        yield ListedSensor(kind, count, bool(modeled), configurations, words, item.span)


def stated_count(words: str) -> int | None:
    """Return how many sensors words such as `two RGBD cameras` state there are; None if unclear."""
    return _count(words, ())


def _count(words: str, below: Iterable[Passage]) -> int | None:
    """Return how many an item states there are: in front, as `(x3)`, or item by item below it."""
    if leading := _LEADING.match(words):
        return int(number_of(leading.group(1)))
    if times := _TIMES.search(words):
        return int(times.group(1) or times.group(2))
    parts = [_LEADING.match(passage.words) for passage in below]
    if parts and all(parts):
        return sum(int(number_of(part.group(1))) for part in parts if part)
    return 1 if _ONE.match(words) and not _VAGUE.search(words) else None
