"""The names that every expression of a xacro file finds, `math` among them."""

from __future__ import annotations

import builtins
import math
import os
import re
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import xacro
from xacro import substitution_args

from checker.formats.xacro.expression.bounds import (
    Allowance,
    Budget,
    ExpressionLimit,
    RefusedExpression,
    check_bits,
)
from checker.formats.xacro.expression.builtins import (
    FUNCTIONS,
    Function,
    Work,
    functions,
    listed,
    mapping,
    unavailable_function,
    weighed,
)
from checker.formats.xacro.expression.format import text_of
from checker.formats.xacro.expression.operators import multiply
from checker.formats.xacro.expression.values import NUMBERS, weigh

# Functions and constants of the module `math` that expressions may use.


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
    values = listed(budget, items)
    weigh(values, budget)
    return math.fsum(values)


def _distance(budget: Budget, *points: Any) -> float:
    values = [listed(budget, point) for point in points]
    for value in values:
        weigh(value, budget)
    return math.dist(*values)


def _product(budget: Budget, items: Any, /, *, start: Any = 1) -> Any:
    values = listed(budget, items)
    if not all(type(value) in NUMBERS for value in (*values, start)):
        weigh(values, budget)
    result = start
    for value in values:
        result = multiply(result, value, budget)
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
        **{name: unavailable_function(f"math.{name}") for name in _PUBLIC},
        **{name: Function(f"math.{name}", work) for name, work in _WORKS.items()},
        **CONSTANTS,
    }
)
"""Everything that `math` offers, by name."""


# Evaluates texts of xacro files, which mix plain words, `${…}` and `$(…)`: as xacro, bounded.


LENGTH_LIMIT = 2_000_000
"""Characters of one value of a text."""
_TOKEN = re.compile(
    r"\$(?P<escaped>\$+[{(])|\$\{(?P<expression>[^}]*)\}|\$\((?P<extension>[^)]*)\)"
    r"|(?P<words>[^$]+|\$[^{($]+|\$$)"
)


def text_value(text: str, symbols: Any, allowance: Allowance) -> Any:
    """Return the value of a text; if it is one expression alone, that value as it is.

    Replaces `xacro.eval_text`.

    Raises:
        xacro.XacroException: It is no such text, or an expression in it fails.
        ExpressionLimit: It would be too long.
    """
    results = [_result(token, symbols) for token in _parts_of(text)]
    if len(results) == 1:
        return results[0]
    budget = Budget(allowance)
    try:
        for result in results:
            if type(result) is not str:
                weigh(result, budget)
        texts = [str(result) for result in results]
    finally:
        budget.close()
    if sum(map(len, texts)) > LENGTH_LIMIT:
        raise ExpressionLimit(f"comes to more than {LENGTH_LIMIT} characters")
    return "".join(texts)


def _parts_of(text: str) -> Iterator[re.Match[str]]:
    """Yield the parts of a text; what xacro cannot read counts one part earlier, as there."""
    position, before = 0, None
    while position < len(text):
        token = _TOKEN.match(text, position)
        if token is None:
            raise xacro.XacroException("invalid expression: " + text[position:])
        if before is not None:
            yield before
        before, position = token, token.end()
    if before is not None:
        yield before


def _result(token: re.Match[str], symbols: Any) -> Any:
    kind, part = str(token.lastgroup), token[str(token.lastgroup)]
    if kind == "expression":
        try:
            return xacro.safe_eval(xacro.eval_text(part, symbols), symbols)
        except Exception as error:
            suffix = f"{os.linesep}when evaluating expression '{part}'"
            raise xacro.XacroException(exc=error, suffix=suffix) from error
    if kind == "extension":
        # As in xacro, where what is not text is written as Python writes it.
        return xacro.eval_extension("$(%s)" % xacro.eval_text(part, symbols))  # noqa: UP031
    return part


_DIRECT = (
    *("list", "dict", "map", "len", "str", "float", "int", "bool", "min", "max", "round"),
    *("sorted", "range"),
)
_SILENT = ("message", "warning", "error", "print_location")
_TRUTH = {"True": True, "False": False}

LoadYaml = Callable[[str, Budget], Any]
"""Returns what a YAML file contains, by the name that the expression gives."""


def global_symbols(load_yaml: LoadYaml) -> dict[str, Any]:
    """Return the replacement of `xacro.create_global_symbols()`."""
    named = functions(
        [
            ("load_yaml", lambda budget, filename: load_yaml(filename, budget)),
            ("abs_filename", weighed(xacro.abs_filename_spec)),
            ("dotify", mapping(xacro.YamlDictWrapper)),
        ]
    )
    others = functions(
        [("arg", _arg), ("fatal", _fatal), ("tokenize", _tokens)]
        + [(f"xacro.{name}", _silent) for name in _SILENT]
    )
    own = {dotted.rpartition(".")[2]: work for dotted, work in (named | others).items()}
    return {
        **{name: FUNCTIONS[name] for name in _DIRECT},
        **_TRUTH,
        **NAMES,
        **named,
        "math": _namespace(NAMES),
        "python": _namespace({**FUNCTIONS, **_TRUTH}),
        "xacro": _namespace(own),
    }


def python_symbols() -> dict[str, Any]:
    """Return all of Python's own names; most of them are refused."""
    known = {name: unavailable_function(name) for name in dir(builtins) if not name.startswith("_")}
    return {**known, **FUNCTIONS, **_TRUTH}


def _namespace(names: Mapping[str, Any]) -> Any:
    namespace = xacro.NameSpace()
    namespace.update(names)
    return namespace


def _arg(budget: Budget, name: Any) -> Any:
    weigh(name, budget)
    return xacro.substitution_args_context["arg"][name]


def _silent(budget: Budget, *values: Any, **how: Any) -> str:
    for value in (*values, *how.values()):
        weigh(value, budget)
    return ""


def _fatal(budget: Budget, *values: Any) -> Any:
    raise xacro.XacroException(" ".join(text_of(value, budget) for value in values))


def _tokens(budget: Budget, s: Any, sep: Any = ",; ", skip_empty: Any = True) -> list[str]:
    if type(sep) is not str or "]" in sep or "\\" in sep:
        raise RefusedExpression("xacro.tokenize() with a pattern as separator")
    weigh(s, budget)
    budget.spend(len(s) // 2 + len(sep))
    parts = re.split(f"[{sep}]", s)
    return [item for item in parts if item] if skip_empty else parts


class EvalNames:
    """The names of `$(eval …)`: functions first, then args, then all of Python's own."""

    def __init__(self, context: dict[str, Any], own: Mapping[str, Any]) -> None:
        """Look up args in a context of xacro, and `own` functions."""
        self._args: dict[str, Any] = context.setdefault("arg", {})
        self._first = {"true": True, "false": False, **_TRUTH, **NAMES, **own}
        self._first["arg"] = Function("arg", lambda _, name: self._value_of_arg(name))
        self._last = python_symbols()

    def __getitem__(self, name: str) -> Any:
        if name in self._first:
            return self._first[name]
        return self._converted(self._args[name]) if name in self._args else self._last[name]

    def _value_of_arg(self, name: Any) -> Any:
        return self._converted(substitution_args._eval_arg(name, self._args))

    @staticmethod
    def _converted(value: Any) -> Any:
        return substitution_args.convert_value(value, "auto")
