"""Text from values: `%`, `format` and f-strings, without look-ups and without endless padding."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from datetime import date, datetime
from string import Formatter
from types import MappingProxyType
from typing import Any

from checker.formats.xacro.expression.bounds import Budget, RefusedExpression, check_width
from checker.formats.xacro.expression.values import PLAIN, type_label, weigh

_PERCENT = re.compile(
    r"%(?:\((?P<name>[^()%]{0,200})\))?[-+ #0]*(?P<width>[0-9]*)(?:\.(?P<precision>[0-9]*))?"
    r"[hlL]?(?P<kind>.?)",
    re.DOTALL,
)
"""Any kind: Python states which ones there are not."""
_SPEC = re.compile(
    r"(?:.?[<>=^])?[-+ ]?z?#?0?(?P<width>\d*)[_,]?(?:\.(?P<precision>\d+))?[bcdeEfFgGnosxX%]?",
    re.DOTALL,
)
_CONVERSIONS: Mapping[str, Callable[[Any], str]] = MappingProxyType(
    {"s": str, "r": repr, "a": ascii}
)
_DIGITS = 20


def check_spec(spec: str, values: Sequence[Any], budget: Budget) -> None:
    """Refuse what follows the colon of a format, if it is not one of numbers or text.

    Raises:
        ValueError: It is no format, as Python states it.
        RefusedExpression: It would format a date.
        ExpressionLimit: It is too wide.
    """
    if spec and any(type(value) in (date, datetime) for value in values):
        raise RefusedExpression("a format of a date")
    match = _SPEC.fullmatch(spec)
    if match is None:
        raise ValueError(f"Invalid format specifier {spec[:40]!r}")
    _spend_on_widths(match, budget)


def formatted(value: Any, conversion: str, spec: str, budget: Budget) -> str:
    """Return a value as an f-string shows it."""
    weigh(value, budget)
    if conversion:
        value = _CONVERSIONS[conversion](value)
    check_spec(spec, [value], budget)
    return format(value, spec)


def format_method(
    text: str, positional: Sequence[Any], named: Mapping[str, Any], budget: Budget
) -> str:
    """Return what `text.format(…)` returns.

    Raises:
        RefusedExpression: A field looks into its value.
    """
    values = [*positional, *named.values()]
    for value in values:
        weigh(value, budget)
    for literal, field, spec, _ in Formatter().parse(text):
        budget.spend_on_text(len(literal))
        if field is None:
            continue
        if re.search(r"[.\[]", field):
            raise RefusedExpression("a format field that looks into its value")
        if "{" in (spec or ""):
            raise RefusedExpression("a format whose width is computed")
        for value in values:
            weigh(value, budget)
        check_spec(spec or "", values, budget)
    return text.format(*positional, **named)


def percent(text: str, values: Any, budget: Budget) -> str:
    """Return what `text % values` returns.

    Raises:
        RefusedExpression: The text is no plain format, or a value is no data.
    """
    budget.spend_on_text(len(text))
    weight = weigh(values, budget)
    position = text.find("%")
    while position >= 0:
        match = _PERCENT.match(text, position)
        if match is None or match["kind"] in ("*", "("):
            raise RefusedExpression(f"the format {text[position : position + 10]!r}")
        _spend_on_widths(match, budget)
        budget.spend(weight)
        position = text.find("%", match.end())
    return str(text % values)


def text_of(value: Any, budget: Budget) -> str:
    """Return a value as `str` shows it."""
    if type(value) not in PLAIN:
        raise RefusedExpression(f"{type_label(value)} as data")
    weigh(value, budget)
    return str(value)


def _spend_on_widths(match: re.Match[str], budget: Budget) -> None:
    for digits in (match["width"], match["precision"]):
        if digits:
            width = int(digits[:_DIGITS])
            check_width(width)
            budget.spend(width // 2)
