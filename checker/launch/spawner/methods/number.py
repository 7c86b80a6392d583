"""Numbers: Ruby's arithmetic, and the methods of Integer, Float and Math."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping

from checker.launch.spawner.limits import MAX_INTEGER_BITS, LimitReached
from checker.launch.spawner.methods.call import Call, Method, Methods
from checker.launch.spawner.values import Value

Number = int | float

_MAX_ROUND_DIGITS = 14
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
    odd = float(right).is_integer() and int(right) % 2 == 1
    try:
        return float(math.pow(left, right))
    except OverflowError:
        return -math.inf if odd and left < 0 else math.inf
    except ValueError:  # 0.0 to a negative power
        return math.copysign(math.inf, left) if odd else math.inf


_OPERATIONS: Mapping[str, Callable[[Number, Number], Number]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divide,
    "%": _modulo,
    "**": _power,
}


def calculate(sign: str, left: Number, right: Number) -> Number | None:
    """Return the result of an arithmetic operator, or None if it is none.

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


def _rounded(number: float, digits: int) -> float:
    """Round halves away from zero, as Ruby does: the double scaled by a power of ten."""
    exponent = math.frexp(number)[1]
    whole = exponent // 4 if exponent > 0 else -(-exponent // 3) - 1
    if not math.isfinite(number) or digits >= 17 - whole:  # no digit is left to lose
        return number
    if digits < -exponent // 4:  # far below the last digit: zero without a sign
        return 0.0
    scale = 10.0**digits
    return math.copysign(_half_up(abs(number), scale) / scale, number)


def _half_up(size: float, scale: float) -> float:
    scaled = size * scale
    if math.isinf(scaled):
        return scaled
    near = float(math.floor(scaled))
    near += scaled - near >= 0.5
    if scale != 1 and (near + 0.5) / scale <= size:
        near += 1
    return near


def _receiver(call: Call) -> Number:
    return call.number(call.receiver)


def _finite(call: Call) -> Number:
    call.truncate(_receiver(call))
    return _receiver(call)


def _round(call: Call, digits: Value = None) -> Value:
    places, number = call.integer(digits) if call.arguments else 0, _receiver(call)
    if not 0 <= places <= _MAX_ROUND_DIGITS:
        raise call.refuse(f"with more than {_MAX_ROUND_DIGITS} digits, or less than none")
    if isinstance(number, int):
        return number
    if places:
        return _rounded(number, places)
    return int(math.copysign(_half_up(abs(_finite(call)), 1.0), number))


def _whole(function: Callable[[Number], int]) -> Method:
    def whole(call: Call) -> Value:
        return function(_finite(call))

    return whole


def _count(call: Call, numbers: Iterable[int]) -> Value:
    for number in numbers:
        call.block_value(number)
    return call.receiver


def _step(call: Call, last: Value, width: Value) -> Value:
    if call.integer(width) < 1:
        raise call.refuse("with a step below 1")
    start, end = call.integer(call.receiver), call.integer(last)
    return _count(call, range(start, end + 1, call.integer(width)))


NUMBER: Methods = {
    "to_i": _whole(int),
    "to_f": lambda call: float(_receiver(call)),
    "round": _round,
    "floor": _whole(math.floor),
    "ceil": _whole(math.ceil),
    "abs": lambda call: abs(_receiver(call)),
    "zero?": lambda call: _receiver(call) == 0,
}

INTEGER: Methods = {
    **NUMBER,
    "even?": lambda call: call.integer(call.receiver) % 2 == 0,
    "odd?": lambda call: call.integer(call.receiver) % 2 == 1,
}

INTEGER_WITH_BLOCK: Methods = {
    "step": _step,
    "times": lambda call: _count(call, range(call.integer(call.receiver))),
    "upto": lambda call, last: _count(
        call, range(call.integer(call.receiver), call.integer(last) + 1)
    ),
}


def _function(compute: Callable[..., float], parameters: int = 1) -> Method:
    def function(call: Call, *numbers: Value) -> Value:
        if len(numbers) != parameters:
            raise call.refuse(f"with {len(numbers)} arguments")
        try:
            result = compute(*(float(call.number(number)) for number in numbers))
        except (ValueError, OverflowError):
            raise call.refuse("outside the function's domain") from None
        return result

    return function


_FUNCTIONS = (math.sqrt, math.sin, math.cos, math.tan, math.asin, math.acos, math.atan)

MATH: Methods = {
    **{function.__name__: _function(function) for function in _FUNCTIONS},
    "atan2": _function(math.atan2, 2),
    "hypot": _function(math.hypot, 2),
}
