"""How Ruby writes values: `to_s` and `inspect`."""

from __future__ import annotations

import math
import re
from decimal import Decimal

from checker.expand.spawner.limits import Budget
from checker.expand.spawner.values import (
    Constant,
    Data,
    ErrorValue,
    RubyArray,
    RubyHash,
    RubyRange,
    RubyString,
    Symbol,
)

_MAX_NESTING = 12
_PLAIN_SYMBOL = re.compile(r"[A-Za-z_][A-Za-z0-9_]*[?!=]?\Z")
_SPECIAL = {
    "\n": "\\n",
    "\t": "\\t",
    "\r": "\\r",
    "\x1b": "\\e",
    "\a": "\\a",
    "\b": "\\b",
    "\v": "\\v",
    "\f": "\\f",
    '"': '\\"',
    "\\": "\\\\",
}


class NotWritable(ValueError):
    """A value whose text Ruby makes of memory addresses, or that is nested too deeply."""


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


def to_s(data: Data, budget: Budget) -> str:
    """Write a value as string interpolation does.

    Raises:
        NotWritable: The value has no text of its own.
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
    return inspect(data, budget)


def inspect(data: Data, budget: Budget, depth: int = 0) -> str:
    """Write a value as it stands inside an array or hash.

    Raises:
        NotWritable: The value has no text of its own.
    """
    budget.spend()
    if depth > _MAX_NESTING:
        raise NotWritable("arrays nested too deeply")
    if isinstance(data, RubyString):
        budget.spend_text(len(data.text))
        return _quoted(data.text)
    if isinstance(data, Symbol):
        name = data.name
        budget.spend_text(len(name))
        return f":{name}" if _PLAIN_SYMBOL.match(name) else f":{_quoted(name)}"
    if isinstance(data, RubyArray):
        return f"[{', '.join(inspect(item.data, budget, depth + 1) for item in data.items)}]"
    if isinstance(data, RubyHash):
        return _hash_text(data, budget, depth + 1)
    return _plain(data, budget)


def _plain(data: Data, budget: Budget) -> str:
    if data is None:
        return "nil"
    if isinstance(data, bool):
        return "true" if data else "false"
    if isinstance(data, int):
        return str(data)
    if isinstance(data, float):
        return float_text(data)
    if isinstance(data, Constant):
        return data.name
    if isinstance(data, RubyRange):
        return to_s(data, budget)
    raise NotWritable(type(data).__name__)


def _hash_text(data: RubyHash, budget: Budget, depth: int) -> str:
    """Write a hash as Ruby up to 3.3 does."""
    entries = [
        f"{inspect(key.data, budget, depth)}=>{inspect(value.data, budget, depth)}"
        for key, value in data.entries.values()
    ]
    return f"{{{', '.join(entries)}}}"


def _quoted(text: str) -> str:
    parts = []
    for at, char in enumerate(text):
        if char == "#" and text[at + 1 : at + 2] in {"{", "$", "@"} and text[at + 1 : at + 2]:
            parts.append("\\#")
        elif char in _SPECIAL:
            parts.append(_SPECIAL[char])
        elif char < " " or char == "\x7f":
            parts.append(f"\\x{ord(char):02X}" if char == "\x7f" else f"\\u{ord(char):04X}")
        else:
            parts.append(char)
    return f'"{"".join(parts)}"'
