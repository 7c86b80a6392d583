"""`format` and `String#%`: the plain directives."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction

from checker.expand.spawner.formatting import NotWritable, to_s
from checker.expand.spawner.methods.call import Call
from checker.expand.spawner.signals import RubyError
from checker.expand.spawner.values import Value

_CLOSE = Fraction(1, 10**9)
"""Far above the error of a double (1e-16), far below any digit that a spawner writes."""
_DIRECTIVE = re.compile(r"%([-+0 #]{0,5})(\d{0,4})(?:\.(\d{1,3}))?(.)?", re.DOTALL)


def formatted(call: Call, template: Value, values: list[Value]) -> Value:
    """Fill values into a template such as `%.3f`.

    Raises:
        Unreadable: A directive that is not read (`%<name>s`, `%p`, `*`).
        RubyError: There are too few values.
    """
    text, waiting, parts, at = call.text(template), iter(values), [], 0
    for found in _DIRECTIVE.finditer(text):
        call.run.budget.spend_text(_width(found))
        parts += [text[at : found.start()], _directive(call, found, waiting)]
        at = found.end()
        call.run.budget.spend()
    parts.append(text[at:])
    return call.run.computed("".join(parts), call.span, template, *values)


def _width(directive: re.Match[str]) -> int:
    """Return how many characters it may write; a digit behind the point costs like ten."""
    return int(directive.group(2) or 0) + 10 * int(directive.group(3) or 0)


def _directive(call: Call, found: re.Match[str], waiting: Iterator[Value]) -> str:
    flags, width, precision, kind = found.groups()
    if found.group() == "%%":
        return "%"
    if kind is None or kind not in "diufFgGeEsx" or "#" in flags:
        raise call.refuse(f"with the directive {found.group()[:20]}")
    value = next(waiting, None)
    if value is None:
        raise RubyError("ArgumentError", "too few arguments", call.span)
    dot = f".{precision}" if precision is not None else ""
    if kind == "s":
        return f"%{flags.replace('0', '')}{width}{dot}s" % _text(call, value)
    number = call.number(value)
    if not math.isfinite(number):
        raise call.refuse(f"with {number} for {found.group()}")
    if kind in "diux":
        if kind == "x" and number < 0:
            raise call.refuse("with a negative number for %x")
        flags = flags.replace("0", "") if dot else flags
        return f"%{flags}{width}{dot}{'x' if kind == 'x' else 'd'}" % math.trunc(number)
    digits = 6 if precision is None else int(precision)
    if _on_limit(float(number), kind.lower(), digits):
        raise call.refuse(f"with {number}, which {found.group()} may round up or down")
    return f"%{flags}{width}{dot}{kind}" % float(number)


def _on_limit(number: float, kind: str, digits: int) -> bool:
    """Whether a number lies so close to a rounding limit that Ruby's own rounding decides.

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
        text = to_s(value.data, call.run.budget)
    except NotWritable as error:
        raise call.refuse(f"with {error}") from None
    call.run.budget.spend_text(len(text))
    return text
