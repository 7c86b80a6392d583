"""Functions of the module Math."""

from __future__ import annotations

import math
from collections.abc import Callable

from checker.expand.spawner.methods.call import Call, Method, Methods
from checker.expand.spawner.values import Value


def _function(compute: Callable[[float], float]) -> Method:
    def one(call: Call, number: Value) -> Value:
        return _result(call, lambda: compute(float(call.number(number))), number)

    return one


def _function_of_two(compute: Callable[[float, float], float]) -> Method:
    def two(call: Call, first: Value, second: Value) -> Value:
        a, b = float(call.number(first)), float(call.number(second))
        return _result(call, lambda: compute(a, b), first, second)

    return two


def _result(call: Call, compute: Callable[[], float], *arguments: Value) -> Value:
    try:
        return call.value(compute(), *arguments)
    except (ValueError, OverflowError):
        raise call.refuse("outside the function's domain") from None


MATH: Methods = {
    **{
        name: _function(getattr(math, name))
        for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log10", "log2")
    },
    "log": _function(math.log),
    "atan2": _function_of_two(math.atan2),
    "hypot": _function_of_two(math.hypot),
}
