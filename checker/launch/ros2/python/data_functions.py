"""Functions of Python's library that turn data into text and back, and that combine data."""

from __future__ import annotations

import ast
import itertools
import json
import math
import textwrap
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import yaml

from checker.launch.ros2.python.expressions import bounded, each, plain
from checker.launch.ros2.values import FileText, OpenFile, Unknown, Value, chosen_value

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

Work = Callable[["Interpreter", ast.AST, list[Value], dict[str, Value]], Value]

_WIDEST = 1_000
"""Greatest length of requested lines and indents."""
_YAML_STYLE = frozenset({"default_flow_style", "sort_keys", "indent", "width", "allow_unicode"})
_JSON_STYLE = frozenset({"indent", "sort_keys", "ensure_ascii"})
_MATH: tuple[Callable[..., Any], ...] = (
    *(math.ceil, math.floor, math.fabs, math.radians, math.degrees, math.sqrt, math.hypot),
    *(math.sin, math.cos, math.tan, math.asin, math.acos, math.atan, math.atan2),
)
CONSTANTS: Mapping[str, float] = MappingProxyType(
    {"math.pi": math.pi, "math.tau": math.tau, "math.e": math.e, "math.inf": math.inf}
)
"""Numbers by the dotted path that an import names them by."""


def _dumping(name: str, write: Callable[..., str], style: frozenset[str]) -> Work:
    """Return what writes data as text; one that writes into a file is not evaluated."""

    def work(
        run: Interpreter, node: ast.AST, arguments: list[Value], named: dict[str, Value]
    ) -> Value:
        if len(arguments) != 1 or not named.keys() <= style:
            return run.unknown(node, f"{name} with these arguments is not evaluated")
        return bounded(run, node, lambda _: write(plain(arguments[0]), **_styled(named)))

    return work


def _styled(named: Mapping[str, Value]) -> dict[str, Any]:
    options = {name: plain(value) for name, value in named.items()}
    if any(type(value) is int and value > _WIDEST for value in options.values()):
        raise ValueError("lines or indents are too wide")
    return options


def _load_json(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    content = chosen_value(arguments[0]) if arguments else None
    if isinstance(content, OpenFile | FileText):
        run.by_argument = True
        source = run.world.read(content.path, run.span(node))
        if isinstance(source, str):
            return run.unknown(node, source)
        content = source.text
    if isinstance(content, Unknown):
        return content
    run.allowance.spend_on_text(len(content) if isinstance(content, str) else 0)
    return bounded(run, node, lambda _: json.loads(plain(content)))


def _mathematics(function: Callable[..., Any]) -> Work:
    def work(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
        return bounded(run, node, lambda _: function(*map(plain, arguments)))

    return work


def _product(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    columns = [each(run, argument, node) for argument in arguments]
    run.allowance.spend(math.prod(map(len, columns)))
    return [*itertools.product(*columns)]


def _dedent(run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]) -> Value:
    return bounded(run, node, lambda _: textwrap.dedent(*map(plain, arguments)))


def _from_keys(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    return bounded(run, node, lambda _: dict.fromkeys(*map(plain, arguments)))


def _get_attribute(
    run: Interpreter, node: ast.AST, arguments: list[Value], _: dict[str, Value]
) -> Value:
    """Return `getattr(owner, name)`; whether there is such an attribute is not known."""
    if len(arguments) != 2:
        return run.unknown(node, "getattr with a default is not evaluated")
    owner, name = map(chosen_value, arguments)
    if not isinstance(name, str):
        return name if isinstance(name, Unknown) else run.unknown(node, "getattr takes a name")
    return run.attribute(owner, str(name), node)


FUNCTIONS: Mapping[str, Work] = MappingProxyType(
    {
        "yaml.dump": _dumping("yaml.dump", yaml.safe_dump, _YAML_STYLE),
        "yaml.safe_dump": _dumping("yaml.safe_dump", yaml.safe_dump, _YAML_STYLE),
        "json.dumps": _dumping("json.dumps", json.dumps, _JSON_STYLE),
        "json.loads": _load_json,
        "json.load": _load_json,
        "itertools.product": _product,
        "textwrap.dedent": _dedent,
        "builtins.dict.fromkeys": _from_keys,
        "builtins.getattr": _get_attribute,
    }
    | {f"math.{function.__name__}": _mathematics(function) for function in _MATH}
)
"""The functions by their dotted path in imports."""
