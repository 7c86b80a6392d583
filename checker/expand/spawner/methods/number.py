"""Methods of Integer and Float."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from checker.expand.spawner.arithmetic import MAX_ROUND_DIGITS, calculate, round_number
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.signals import RubyError
from checker.expand.spawner.values import Value


def _own(call: Call) -> int | float:
    return call.number(call.receiver)


def _finite(call: Call) -> int | float:
    number = _own(call)
    call.whole(number)
    return number


def _round(call: Call, digits: Value | None = None) -> Value:
    places = call.integer(digits) if digits else 0
    if places > MAX_ROUND_DIGITS:
        raise call.refuse(f"with more than {MAX_ROUND_DIGITS} digits")
    number = _finite(call) if places <= 0 else _own(call)
    return call.value(round_number(number, places))


def _whole(function: Callable[[int | float], int]) -> Callable[[Call], Value]:
    return lambda call: call.value(function(_finite(call)))


def _compare(test: Callable[[int | float], bool]) -> Callable[[Call], Value]:
    return lambda call: call.value(test(_own(call)))


def _div(call: Call, other: Value) -> Value:
    number = call.number(other)
    if number == 0:
        raise RubyError("ZeroDivisionError", "divided by 0", call.span)
    return call.value(call.whole(_finite(call) // number), other)


def _fdiv(call: Call, other: Value) -> Value:
    return call.value(calculate("/", float(_own(call)), float(call.number(other))), other)


def _modulo(call: Call, other: Value) -> Value:
    try:
        return call.value(calculate("%", _own(call), call.number(other)), other)
    except ZeroDivisionError:
        raise RubyError("ZeroDivisionError", "divided by 0", call.span) from None


def _divmod(call: Call, other: Value) -> Value:
    return call.run.array([_div(call, other), _modulo(call, other)], call.receiver)


def _between(call: Call, low: Value, high: Value) -> Value:
    return call.value(call.number(low) <= _own(call) <= call.number(high), low, high)


def _clamp(call: Call, low: Value, high: Value) -> Value:
    lowest, highest = call.number(low), call.number(high)
    if lowest > highest:
        raise call.refuse("with bounds in the wrong order")
    number = _own(call)
    chosen = lowest if number < lowest else highest if number > highest else number
    return call.value(chosen, low, high)


def _count(call: Call, numbers: Iterable[int]) -> Value:
    for number in numbers:
        call.each(call.value(number))
    return call.receiver


def _times(call: Call) -> Value:
    return _count(call, range(call.integer(call.receiver)))


def _upto(call: Call, last: Value) -> Value:
    return _count(call, range(call.integer(call.receiver), call.integer(last) + 1))


def _downto(call: Call, last: Value) -> Value:
    return _count(call, range(call.integer(call.receiver), call.integer(last) - 1, -1))


def _step(call: Call, last: Value, width: Value) -> Value:
    if call.integer(width) < 1:
        raise call.refuse("with a step below 1")
    start, end = call.integer(call.receiver), call.integer(last)
    return _count(call, range(start, end + 1, call.integer(width)))


NUMBER: Methods = {
    "to_i": _whole(int),
    "to_int": _whole(int),
    "truncate": _whole(int),
    "to_f": lambda call: call.value(float(_own(call))),
    "round": _round,
    "floor": _whole(math.floor),
    "ceil": _whole(math.ceil),
    "abs": lambda call: call.value(abs(_own(call))),
    "zero?": _compare(lambda number: number == 0),
    "positive?": _compare(lambda number: number > 0),
    "negative?": _compare(lambda number: number < 0),
    "div": _div,
    "fdiv": _fdiv,
    "modulo": _modulo,
    "divmod": _divmod,
    "between?": _between,
    "clamp": _clamp,
    "-@": lambda call: call.value(-_own(call)),
    "integer?": lambda call: call.value(isinstance(_own(call), int)),
}

INTEGER: Methods = {
    "even?": lambda call: call.value(call.integer(call.receiver) % 2 == 0),
    "odd?": lambda call: call.value(call.integer(call.receiver) % 2 == 1),
    "succ": lambda call: call.value(call.integer(call.receiver) + 1),
    "next": lambda call: call.value(call.integer(call.receiver) + 1),
    "pred": lambda call: call.value(call.integer(call.receiver) - 1),
}

INTEGER_WITH_BLOCK: Methods = {
    "times": _times,
    "upto": _upto,
    "downto": _downto,
    "step": _step,
}

FLOAT: Methods = {
    "nan?": _compare(math.isnan),
    "finite?": _compare(math.isfinite),
}
