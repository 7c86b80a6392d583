"""Text to numbers, as `to_i` and `to_f` read it: what leads the text counts."""

from __future__ import annotations

import re

from checker.expand.spawner.limits import MAX_INTEGER_BITS, LimitReached

_INTEGER = re.compile(r"\s*([+-]?\d{1,400}(?:_\d{1,400})*)")
_FLOAT = re.compile(r"\s*([+-]?\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?(?:[eE][+-]?\d+)?)")
_DIGITS = MAX_INTEGER_BITS // 4


def leading_integer(text: str) -> int:
    """Return the integer at the start of a text, else 0.

    Raises:
        LimitReached: It has too many digits.
    """
    found = _INTEGER.match(text)
    digits = found.group(1).replace("_", "") if found else "0"
    if len(digits) > _DIGITS:
        raise LimitReached(f"makes an integer of more than {_DIGITS} digits")
    return int(digits)


def leading_float(text: str) -> float:
    """Return the number at the start of a text, else 0.0."""
    found = _FLOAT.match(text[:2000])
    return float(found.group(1).replace("_", "")) if found else 0.0


def whole_number(text: str) -> int | None:
    """Return the integer that a whole text writes in decimal digits, else None."""
    found = _INTEGER.fullmatch(text.strip())
    digits = found.group(1).replace("_", "") if found else ""
    plain = digits.lstrip("+-")
    octal = len(plain) > 1 and plain[0] == "0"
    return int(digits) if plain and len(plain) <= _DIGITS and not octal else None


def whole_float(text: str) -> float | None:
    """Return the number that a whole text writes, else None."""
    found = _FLOAT.fullmatch(text.strip()[:2000])
    return float(found.group(1).replace("_", "")) if found else None
