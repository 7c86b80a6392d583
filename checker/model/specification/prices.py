"""What a sheet says that the robot costs: parts and their sum."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.record import record
from checker.source.text import Span

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


@record(eq=False)
class Price:
    """A price.

    Attributes:
        amount: In the currency of the sheet.
        span: Number and currency.
        is_sum: Whether its line says that it is the whole.
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
        found = _PRICE.search(line[:LINE_LIMIT])
        if found and number < MAX_LINES:
            before, behind = line[: found.start()], line[found.end() : LINE_LIMIT]
            is_sum = _SUM.search(before) is not None
            in_list = _ITEM.match(before) or _CELL.match(before)
            yield Price(
                float(re.sub(r"[,']", "", found.group(1) or found.group(2))),
                Span(stretch.source, offset + found.start(), offset + found.end()),
                is_sum,
                bool(in_list) and not is_sum,
                not (_MULTIPLIED.match(behind) or _EACH.search(line[:LINE_LIMIT])),
            )
        offset += len(line)
