"""Masses in the sheet, and which of them is the robot's."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from checker.model.specification.quantities import (
    NUMBER,
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

MAX_STATEMENTS = 50
# Kilograms per unit; the pound by definition (international agreement of 1959).
_UNITS = {"k": 1.0, "g": 1e-3, "l": 0.45359237, "p": 0.45359237}
_MASS = re.compile(
    rf"(?<![\w.])({NUMBER})\s{{0,5}}(kgs?|kilo(?:gram)?s?|grams?|lbs?|pounds?)\b", re.IGNORECASE
)
_SUBJECT = re.compile(r"\b(?:weigh(?:s|ts)?|weight|mass)\b", re.IGNORECASE)
_CLAUSE = re.compile(r"[,;:]|\band\b", re.IGNORECASE)
_NOT_THE_ROBOT = re.compile(
    r"\b(?:payload|batter\w*|sensors?|backpack|under|below|less|up|over|more|carr\w*|lift\w*|max\w*"
    r"|min\w*|module|per|each|without|base|additional|arm|wheels?|drone|center|balance)\b",
    re.IGNORECASE,
)


def masses(passages: Iterable[Passage]) -> Iterator[Quantity]:
    """Yield every mass; it is the robot's when its words say `weighs`, `weight`, `mass` of it."""
    for passage in passages:
        for sentence in sentences(passage):
            last = 0
            named = configurations_in(sentence.text)
            for found in _MASS.finditer(sentence.text):
                yield _mass(sentence, found, sentence.text[last : found.start()], named)
                last = found.end()


def _mass(sentence: Sentence, found: re.Match[str], before: str, named: frozenset[int]) -> Quantity:
    number, unit = found.groups()
    factor = _UNITS[unit[0].lower()]
    about_robot = _SUBJECT.search(before) and not _NOT_THE_ROBOT.search(_clause(before))
    return Quantity(
        QuantityKind.TOTAL_MASS if about_robot else QuantityKind.MASS,
        number_of(number) * factor,
        resolution_of(number) * factor,
        unit,
        is_approximate(before),
        named,
        sentence.part(*found.span()),
    )


def _clause(before: str) -> str:
    """Return the words that belong to the last `weighs`: from the comma or `and` before it on."""
    verb = [found.start() for found in _SUBJECT.finditer(before)][-1]
    breaks = [found.end() for found in _CLAUSE.finditer(before, 0, verb)]
    return before[breaks[-1] if breaks else 0 :]


def total_mass(stated: Sequence[Quantity]) -> Quantity | None:
    """Return the robot's mass, or None when the sheet gives none or several.

    Of an exact and an approximate statement the exact one counts, and a rounded one (3.6 kg) gives
    way to one with more digits (3557 g). Statements about named configurations do not count.
    """
    totals = [
        mass for mass in stated if mass.kind is QuantityKind.TOTAL_MASS and not mass.configurations
    ]
    best = [mass for mass in totals if not mass.approximate] or totals
    if len(best) > MAX_STATEMENTS:
        return None
    kept = [mass for mass in best if not any(_rounds(other, mass) for other in best)]
    return kept[0] if kept and all(mass.value == kept[0].value for mass in kept) else None


def _rounds(finer: Quantity, coarser: Quantity) -> bool:
    closest = 0.5 * coarser.resolution * (1 + 1e-9)
    return finer.resolution < coarser.resolution and abs(finer.value - coarser.value) <= closest
