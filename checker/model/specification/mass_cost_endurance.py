"""Claims of a sheet about mass, cost and endurance."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record
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
from checker.source.text import Span

# How long the robot runs, and how long its model is said to run.


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
    """Yield the durations of an endurance section that state how long the robot runs."""
    for passage in passages:
        for sentence in sentences(passage):
            last = 0
            for match in _DURATION.finditer(sentence.text):
                quantity = _duration(sentence, match, sentence.text[last : match.start()])
                last = match.end()
                if quantity is not None:
                    yield quantity


def _duration(sentence: Sentence, match: re.Match[str], before: str) -> Quantity | None:
    if _BOUND.search(before):
        return None
    if _LIMIT.search(before):
        kind = QuantityKind.ENDURANCE_LIMIT
    elif _ENDURANCE.search(before):
        kind = QuantityKind.ENDURANCE
    else:
        return None
    number, unit, rest, rest_unit = match.groups()
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
        sentence.part(*match.span()),
    )


def endurance(stated: Sequence[Quantity]) -> Quantity | None:
    """Return how long the model is said to run, in s, or None if the sheet is not clear.

    What the model is limited to counts more than what the robot reaches.
    """
    general = [duration for duration in stated if not duration.configurations]
    limits = [quantity for quantity in general if quantity.kind is QuantityKind.ENDURANCE_LIMIT]
    for same_kind in (limits, general):
        if same_kind:
            first = same_kind[0]
            agree = all(
                abs(quantity.value - first.value) <= _SAME * first.value for quantity in same_kind
            )
            return first if agree else None
    return None


# What a sheet says that the robot costs: parts and their sum.


MAX_LINES = 500
LINE_LIMIT = 1000
_CURRENCY = r"(?:US\s?\$|USD|AUD|EUR|GBP|CHF|CAD|\$|€|£)"
_AMOUNT = r"\d{1,9}(?:[,']\d{3}){0,4}(?:\.\d{1,2})?"
_PRICE = re.compile(
    rf"{_CURRENCY}\s?({_AMOUNT})(?![\d%])"
    rf"|(?<![\w.,$])({_AMOUNT})\s?(?:{_CURRENCY}|dollars?\b|euros?\b)",
    re.IGNORECASE,
)
_MULTIPLIED = re.compile(r"\s?(?:k|thousand|million)\b|\s?(?:-|–|to)\s?\W?\d", re.IGNORECASE)
_EACH = re.compile(r"\b(?:each|apiece|per|month|year|optional)\b", re.IGNORECASE)
_SUM = re.compile(
    r"\btotal\b|\b(?:sum|altogether|together)\b|\bcosts?\s+(?:of|is|about|around)\b", re.IGNORECASE
)
# `$200 - D435`, `* Base vehicle: $12,000`, `| body | USD 2,000 |`: a price and what it is for.
_ITEM = re.compile(
    r"\s*+(?:[-*+]\s++)?(?:[^|:]{0,200}:\s*+)?(?:~|about|approx\.?)?\s*+$", re.IGNORECASE
)
_CELL = re.compile(r"\s*+\|.{0,300}\|\s*+(?:~|about)?\s*+$", re.IGNORECASE)


class Price(Record, eq=False):
    """A price.

    Attributes:
        amount: The amount in the currency of the sheet.
        span: The number and currency.
        is_sum: Whether its line states that it is the whole.
        is_part: Whether its line is an item: a price and what it is for.
        is_clear: Whether it is one number for one thing, no range and no price a piece.
    """

    amount: float
    span: Span
    is_sum: bool
    is_part: bool
    is_clear: bool


def prices(stretch: Span) -> tuple[Price, ...]:
    """Return the first price of each line of a stretch; what follows in a line explains it."""
    return tuple(_prices(stretch))


def _prices(stretch: Span) -> Iterator[Price]:
    offset = stretch.start
    for number, line in enumerate(stretch.text.splitlines(keepends=True)):
        match = _PRICE.search(line[:LINE_LIMIT])
        if match and number < MAX_LINES:
            before, behind = line[: match.start()], line[match.end() : LINE_LIMIT]
            is_sum = _SUM.search(before) is not None
            in_list = _ITEM.match(before) or _CELL.match(before)
            yield Price(
                float(re.sub(r"[,']", "", match.group(1) or match.group(2))),
                Span(stretch.source, offset + match.start(), offset + match.end()),
                is_sum,
                bool(in_list) and not is_sum,
                not (_MULTIPLIED.match(behind) or _EACH.search(line[:LINE_LIMIT])),
            )
        offset += len(line)


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
    """Yield every mass; it is the robot's when its words state `weighs`, `weight`, `mass` of it."""
    for passage in passages:
        for sentence in sentences(passage):
            last = 0
            named = configurations_in(sentence.text)
            for match in _MASS.finditer(sentence.text):
                yield _mass(sentence, match, sentence.text[last : match.start()], named)
                last = match.end()


def _mass(sentence: Sentence, match: re.Match[str], before: str, named: frozenset[int]) -> Quantity:
    number, unit = match.groups()
    factor = _UNITS[unit[0].lower()]
    about_robot = _SUBJECT.search(before) and not _NOT_THE_ROBOT.search(_clause(before))
    return Quantity(
        QuantityKind.TOTAL_MASS if about_robot else QuantityKind.MASS,
        number_of(number) * factor,
        resolution_of(number) * factor,
        unit,
        is_approximate(before),
        named,
        sentence.part(*match.span()),
    )


def _clause(before: str) -> str:
    """Return the words that belong to the last `weighs`: from the comma or `and` before it on."""
    verb = [match.start() for match in _SUBJECT.finditer(before)][-1]
    breaks = [match.end() for match in _CLAUSE.finditer(before, 0, verb)]
    return before[breaks[-1] if breaks else 0 :]


def total_mass(stated: Sequence[Quantity]) -> Quantity | None:
    """Return the robot's mass, or None if the sheet gives none or several.

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
