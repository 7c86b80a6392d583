"""Ruby's arithmetic on integers and floats."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from fractions import Fraction
from types import MappingProxyType

from checker.expand.spawner.limits import MAX_INTEGER_BITS, LimitReached

Number = int | float

MAX_ROUND_DIGITS = 14
"""Ruby rounds the scaled double up to here, and by other means beyond."""


class NotReal(ValueError):
    """The result would be a Rational or a Complex number, which the reader does not know."""


def _divide(left: Number, right: Number) -> Number:
    if isinstance(left, int) and isinstance(right, int):
        return left // right
    if right == 0:
        if left == 0 or math.isnan(left):
            return math.nan
        return math.copysign(math.inf, left) * math.copysign(1.0, right)
    return left / right


def _modulo(left: Number, right: Number) -> Number:
    if isinstance(left, int) and isinstance(right, int):
        return left % right
    if right == 0:
        raise ZeroDivisionError
    if math.isinf(left):
        return math.nan
    rest = math.fmod(left, right)
    return rest + right if rest * right < 0 else rest  # the product may underflow, as in Ruby


def _power(left: Number, right: Number) -> Number:
    if isinstance(left, int) and isinstance(right, int):
        if right < 0:
            raise NotReal("an integer to a negative power is a Rational")
        if left.bit_length() * right > MAX_INTEGER_BITS * 2:
            raise LimitReached(f"makes an integer of more than {MAX_INTEGER_BITS} bits")
        return int(left**right)
    if left < 0 and not float(right).is_integer() and not math.isinf(right):
        raise NotReal("a negative number to a broken power is Complex")
    try:
        return float(math.pow(left, right))
    except OverflowError:
        odd = left < 0 and float(right).is_integer() and int(right) % 2 == 1
        return -math.inf if odd else math.inf
    except ValueError:  # 0.0 to a negative power
        odd = float(right).is_integer() and int(right) % 2 == 1
        return math.copysign(math.inf, left) if odd else math.inf


_OPERATIONS: Mapping[str, Callable[[Number, Number], Number]] = MappingProxyType(
    {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "/": _divide,
        "%": _modulo,
        "**": _power,
    }
)


def calculate(sign: str, left: Number, right: Number) -> Number | None:
    """Return the result of an arithmetic operator, or None when it is none.

    Raises:
        ZeroDivisionError: Division of an integer by the integer 0, or a remainder by any 0.
        NotReal: The result is no integer and no float.
        LimitReached: The integer becomes too large.
    """
    operation = _OPERATIONS.get(sign)
    if operation is None:
        return None
    result = operation(left, right)
    if isinstance(result, int) and result.bit_length() > MAX_INTEGER_BITS:
        raise LimitReached(f"makes an integer of more than {MAX_INTEGER_BITS} bits")
    return result


def round_number(number: Number, digits: int = 0) -> Number:
    """Round halves away from zero, as Ruby does: the double scaled by a power of ten.

    Args:
        number: Finite when no digits behind the point are asked for.
        digits: Digits behind the point, at most `MAX_ROUND_DIGITS`; floats stay floats for some.
    """
    if isinstance(number, int):
        return number if digits >= 0 else _round_whole(Fraction(number), digits)
    if digits < 0:
        return _round_whole(Fraction(number), digits)
    if digits == 0:
        return int(math.copysign(_half_up(abs(number), 1.0), number))
    if not math.isfinite(number) or _already_round(number, digits):
        return number
    if digits < -math.frexp(number)[1] // 4:  # far below the last digit: zero without a sign
        return 0.0
    scale = 10.0**digits
    return math.copysign(_half_up(abs(number), scale) / scale, number)


def _already_round(number: float, digits: int) -> bool:
    """Whether a double has no digits behind `digits` to lose."""
    exponent = math.frexp(number)[1]
    whole = exponent // 4 if exponent > 0 else -(-exponent // 3) - 1
    return digits >= 17 - whole


def _half_up(size: float, scale: float) -> float:
    scaled = size * scale
    if math.isinf(scaled):
        return scaled
    near = float(math.floor(scaled))
    near += scaled - near >= 0.5
    if scale != 1 and (near + 0.5) / scale <= size:
        near += 1
    return near


def _round_whole(number: Fraction, digits: int) -> int:
    if digits < -400:
        return 0
    scale = int(10**-digits)
    near = math.floor(abs(number) / scale + Fraction(1, 2)) * scale
    return near if number >= 0 else -near
