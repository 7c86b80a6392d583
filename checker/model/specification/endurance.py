"""How long the robot runs, and how long its model is said to run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from checker.model.specification.quantities import (
    NUMBER,
    WORDS,
    Quantity,
    QuantityKind,
    Sentence,
    configurations_in,
    is_approximate,
    number_of,
    resolution_of,
    sentences,
)
from checker.source.markdown import Passage

_SECONDS = {"h": 3600.0, "m": 60.0, "s": 1.0}
_UNIT = r"(hours?|hrs?|h|minutes?|mins?|seconds?|secs?|s)\b"
_DURATION = re.compile(
    rf"(?<![\w.])({NUMBER}|{'|'.join(WORDS)})[\s-]{{0,5}}{_UNIT}"
    rf"(?:\s{{1,5}}(?:and\s{{1,5}})?({NUMBER})\s{{0,5}}(minutes?|mins?|seconds?|secs?)\b)?",
    re.IGNORECASE,
)
_LIMIT = re.compile(
    r"\blimited\b|\bset\s+(?:to|at)\b|\b(?:modell?ed|simulated)\s+(?:as|to)\b", re.IGNORECASE
)
_ENDURANCE = re.compile(
    r"\bbattery\s+(?:life|lasts)\b|\bendurance\b|\brun[\s-]?time\b|\bflight\s+time\b",
    re.IGNORECASE,
)
_BOUND = re.compile(r"\b(?:over|more\s+than|at\s+least|up\s+to|after|for)\s*$", re.IGNORECASE)
# Two statements this close are one figure and its rounding: `2 hours`, `2 hours and 6 minutes`.
_SAME = 0.1


def durations(passages: Iterable[Passage]) -> Iterator[Quantity]:
    """Yield the durations of an endurance section that say how long the robot runs."""
    for passage in passages:
        for sentence in sentences(passage):
            last = 0
            for found in _DURATION.finditer(sentence.text):
                quantity = _duration(sentence, found, sentence.text[last : found.start()])
                last = found.end()
                if quantity is not None:
                    yield quantity


def _duration(sentence: Sentence, found: re.Match[str], before: str) -> Quantity | None:
    if _BOUND.search(before):
        return None
    if _LIMIT.search(before):
        kind = QuantityKind.ENDURANCE_LIMIT
    elif _ENDURANCE.search(before):
        kind = QuantityKind.ENDURANCE
    else:
        return None
    number, unit, rest, rest_unit = found.groups()
    factor = _SECONDS[unit[0].lower()]
    value, resolution = number_of(number) * factor, resolution_of(number) * factor
    if rest:
        factor = _SECONDS[rest_unit[0].lower()]
        value, resolution = value + number_of(rest) * factor, resolution_of(rest) * factor
    return Quantity(
        kind,
        value,
        resolution,
        unit,
        is_approximate(before),
        configurations_in(sentence.text),
        sentence.part(*found.span()),
    )


def endurance(stated: Sequence[Quantity]) -> Quantity | None:
    """Return how long the model is said to run, in s, or None when the sheet is not clear.

    What the model is limited to counts more than what the robot reaches.
    """
    general = [duration for duration in stated if not duration.configurations]
    limits = [each for each in general if each.kind is QuantityKind.ENDURANCE_LIMIT]
    for same_kind in (limits, general):
        if same_kind:
            first = same_kind[0]
            agree = all(abs(each.value - first.value) <= _SAME * first.value for each in same_kind)
            return first if agree else None
    return None
