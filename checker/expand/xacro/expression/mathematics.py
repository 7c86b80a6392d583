"""Functions and constants of the module `math` that expressions may use."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from checker.expand.xacro.expression.bounds import Budget, check_bits
from checker.expand.xacro.expression.builtins import listed
from checker.expand.xacro.expression.function import Function, Work, refused, weighed
from checker.expand.xacro.expression.operators import multiply
from checker.expand.xacro.expression.values import NUMBERS, weigh

_READING = (
    *("acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "copysign"),
    *("cos", "cosh", "degrees", "erf", "erfc", "exp", "exp2", "expm1", "fabs", "floor"),
    *("fmod", "frexp", "gamma", "gcd", "hypot", "isclose", "isfinite", "isinf", "isnan"),
    *("isqrt", "ldexp", "lgamma", "log", "log10", "log1p", "log2", "modf", "nextafter", "pow"),
    *("radians", "remainder", "sin", "sinh", "sqrt", "tan", "tanh", "trunc", "ulp"),
)


def _growing(name: str) -> Work:
    """Return a function whose result may be far larger than its arguments."""
    native = getattr(math, name)

    def work(budget: Budget, *arguments: Any) -> Any:
        for value in arguments:
            weigh(value, budget)
        if arguments and all(type(value) in (int, bool) for value in arguments):
            check_bits(_bits(name, *arguments))
        budget.spend(64)
        return native(*arguments)

    return work


def _bits(name: str, *numbers: int) -> int:
    """Return how many bits the result has at most."""
    first, last = numbers[0], numbers[-1]
    if name == "lcm":
        return sum(number.bit_length() for number in numbers)
    if name == "comb" and 0 <= last <= first:
        last = min(last, first - last)
    return max(first, 0).bit_length() * max(last, 0)


def _sum(budget: Budget, items: Any, /) -> float:
    found = listed(budget, items)
    weigh(found, budget)
    return math.fsum(found)


def _distance(budget: Budget, *points: Any) -> float:
    found = [listed(budget, each) for each in points]
    for each in found:
        weigh(each, budget)
    return math.dist(*found)


def _product(budget: Budget, items: Any, /, *, start: Any = 1) -> Any:
    found = listed(budget, items)
    if not all(type(each) in NUMBERS for each in (*found, start)):
        weigh(found, budget)
    result = start
    for each in found:
        result = multiply(result, each, budget)
    return result


_GROWING = ("comb", "factorial", "lcm", "perm")
_WORKS: Mapping[str, Work] = MappingProxyType(
    {name: weighed(getattr(math, name)) for name in _READING if hasattr(math, name)}
    | {name: _growing(name) for name in _GROWING}
    | {"dist": _distance, "fsum": _sum, "prod": _product}
)
_PUBLIC = tuple(name for name in vars(math) if not name.startswith("_"))
CONSTANTS: Mapping[str, float] = MappingProxyType(
    {name: getattr(math, name) for name in ("e", "inf", "nan", "pi", "tau")}
)
NAMES: Mapping[str, Any] = MappingProxyType(
    {
        **{name: refused(f"math.{name}") for name in _PUBLIC},
        **{name: Function(f"math.{name}", work) for name, work in _WORKS.items()},
        **CONSTANTS,
    }
)
"""Everything that `math` offers, by name."""
