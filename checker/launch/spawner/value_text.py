"""Ruby's texts of values: `to_s`, `inspect`, and the plain directives of `format`."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from checker.launch.spawner.limits import Budget
from checker.launch.spawner.signals import RubyError
from checker.launch.spawner.values import (
    ErrorValue,
    RubyArray,
    RubyRange,
    RubyString,
    Symbol,
    Value,
    class_name,
)

if TYPE_CHECKING:
    from checker.launch.spawner.methods.call import Call

_MAX_NESTING = 12
_CLOSE = Fraction(1, 10**9)
"""Far above the error of a double (1e-16), far below any digit that a spawner writes."""
_DIRECTIVE = re.compile(r"%([-+0 ]{0,4})(\d{0,4})(?:\.(\d{1,3}))?(.)?", re.DOTALL)


class NotWritable(ValueError):
    """A value whose text spawners do not use, or that is nested too deeply."""


def float_text(number: float) -> str:
    """Write a float as Ruby does: the shortest digits that read back as the same number.

    Ruby writes an exponent below 0.0001, and from 1e15 on unless digits behind the point are
    left (up to 1e16).
    """
    if math.isnan(number):
        return "NaN"
    if math.isinf(number):
        return "Infinity" if number > 0 else "-Infinity"
    size = abs(number)
    if size == 0 or 1e-4 <= size < 1e15 or (1e15 <= size < 1e16 and size % 1):
        return repr(number)
    sign, digits, exponent = Decimal(repr(number)).normalize().as_tuple()
    text = "".join(map(str, digits))
    power = int(exponent) + len(digits) - 1
    mark = "-" if power < 0 else "+"
    return f"{'-' * sign}{text[0]}.{text[1:] or '0'}e{mark}{abs(power):02d}"


def interpolate(data: Value, budget: Budget) -> str:
    """Write a value as string interpolation does.

    Raises:
        NotWritable: The value has no text form.
    """
    if data is None:
        return ""
    if isinstance(data, RubyString):
        return data.text
    if isinstance(data, Symbol):
        return data.name
    if isinstance(data, ErrorValue):
        return data.message
    if isinstance(data, RubyRange):
        return f"{data.first}{'...' if data.exclusive else '..'}{data.last}"
    return _element_text(data, budget, 0)


def _element_text(data: Value, budget: Budget, depth: int) -> str:
    """Write a value as it is inside an array: numbers, as in a pose."""
    budget.spend()
    if depth > _MAX_NESTING:
        raise NotWritable("arrays nested too deeply")
    if isinstance(data, RubyArray):
        elements = [_element_text(item, budget, depth + 1) for item in data.items]
        return f"[{', '.join(elements)}]"
    if data is None:
        return "nil"
    if isinstance(data, float):
        return float_text(data)
    if isinstance(data, int):
        return str(data).lower()
    within = " in an array" if depth else ""
    raise NotWritable(f"a value of the class {class_name(data)}{within}")


def formatted(call: Call, template: Value, values: list[Value]) -> Value:
    """Fill values into a template such as `%.3f`.

    Raises:
        Unreadable: A directive that is not read (`%<name>s`, `%p`, `*`).
        RubyError: There are too few values.
    """
    text, waiting, parts, at = call.text(template), iter(values), [], 0
    for match in _DIRECTIVE.finditer(text):
        call.run.budget.spend_text(_width(match))
        parts += [text[at : match.start()], _directive(call, match, waiting)]
        at = match.end()
        call.run.budget.spend()
    parts.append(text[at:])
    return call.run.computed("".join(parts), call.span)


def _width(directive: re.Match[str]) -> int:
    """Return how many characters it may write; a digit behind the point costs like ten."""
    return int(directive.group(2) or 0) + 10 * int(directive.group(3) or 0)


def _directive(call: Call, match: re.Match[str], waiting: Iterator[Value]) -> str:
    flags, width, precision, kind = match.groups()
    if match.group() == "%%":
        return "%"
    if kind is None or kind not in "difegs":
        raise call.refuse(f"with the directive {match.group()[:20]}")
    try:
        value = next(waiting)
    except StopIteration:
        raise RubyError("ArgumentError", "too few arguments", call.span) from None
    dot = f".{precision}" if precision is not None else ""
    if kind == "s":
        return f"%{flags.replace('0', '')}{width}{dot}s" % _text(call, value)
    number = call.number(value)
    if not math.isfinite(number):
        raise call.refuse(f"with {number} for {match.group()}")
    if kind in "di":
        flags = flags.replace("0", "") if dot else flags
        return f"%{flags}{width}{dot}d" % math.trunc(number)
    if _on_limit(float(number), kind, 6 if precision is None else int(precision)):
        raise call.refuse(f"with {number}, which {match.group()} may round up or down")
    return f"%{flags}{width}{dot}{kind}" % float(number)


def _on_limit(number: float, kind: str, digits: int) -> bool:
    """Return whether Ruby's own rounding decides for a number close to a rounding limit.

    Ruby finds the digits by doubles, C by the exact value: they differ next to a half.
    """
    if number == 0:
        return False
    if kind != "f":
        leading = Decimal(number).adjusted()
        digits = (max(digits, 1) - 1 if kind == "g" else digits) - leading
    scaled = abs(Fraction(number)) * Fraction(10) ** digits
    distance = abs(scaled % 1 - Fraction(1, 2))
    return distance < _CLOSE * max(scaled, Fraction(1)) and (distance > 0 or kind == "g")


def _text(call: Call, value: Value) -> str:
    try:
        text = interpolate(value, call.run.budget)
    except NotWritable as error:
        raise call.refuse(f"with {error}") from None
    call.run.budget.spend_text(len(text))
    return text
