"""Functions of Python's library that turn data into text and back, and that combine data."""

from __future__ import annotations

import itertools
import json
import math
import textwrap
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import yaml

from checker.launch.ros2.python.call import Call, Work
from checker.launch.ros2.python.expressions import bounded, plain
from checker.launch.ros2.values import FileText, OpenFile, Unknown, Value, chosen_value

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

    def work(call: Call) -> Value:
        if len(call.arguments) != 1 or not call.named.keys() <= style:
            return call.unknown(f"{name} with these arguments is not evaluated")
        return bounded(
            call.run, call.node, lambda _: write(plain(call.arguments[0]), **_styled(call.named))
        )

    return work


def _styled(named: Mapping[str, Value]) -> dict[str, Any]:
    options = {name: plain(value) for name, value in named.items()}
    if any(type(value) is int and value > _WIDEST for value in options.values()):
        raise ValueError("lines or indents are too wide")
    return options


def _load_json(call: Call) -> Value:
    content = chosen_value(call.first())
    if isinstance(content, OpenFile | FileText):
        call.run.by_argument = True
        source = call.run.world.read(content.path, call.span)
        if isinstance(source, str):
            return call.unknown(source)
        content = source.text
    if isinstance(content, Unknown):
        return content
    call.run.allowance.spend_on_text(len(content) if isinstance(content, str) else 0)
    return bounded(call.run, call.node, lambda _: json.loads(plain(content)))


def _of_data(function: Callable[..., Any]) -> Work:
    """Return what calls a function of Python with data."""
    return lambda call: bounded(
        call.run, call.node, lambda _: function(*map(plain, call.arguments))
    )


def _product(call: Call) -> Value:
    columns = [*map(call.items, call.arguments)]
    call.run.allowance.spend(math.prod(map(len, columns)))
    return [*itertools.product(*columns)]


def _get_attribute(call: Call) -> Value:
    """Return `getattr(owner, name)`; whether there is such an attribute is not known."""
    if len(call.arguments) != 2:
        return call.unknown("getattr with a default is not evaluated")
    owner, name = map(chosen_value, call.arguments)
    if not isinstance(name, str):
        return name if isinstance(name, Unknown) else call.unknown("getattr takes a name")
    return call.run.attribute(owner, str(name), call.node)


FUNCTIONS: Mapping[str, Work] = MappingProxyType(
    {
        "yaml.dump": _dumping("yaml.dump", yaml.safe_dump, _YAML_STYLE),
        "yaml.safe_dump": _dumping("yaml.safe_dump", yaml.safe_dump, _YAML_STYLE),
        "json.dumps": _dumping("json.dumps", json.dumps, _JSON_STYLE),
        "json.loads": _load_json,
        "json.load": _load_json,
        "itertools.product": _product,
        "textwrap.dedent": _of_data(textwrap.dedent),
        "builtins.dict.fromkeys": _of_data(dict.fromkeys),
        "builtins.getattr": _get_attribute,
    }
    | {f"math.{function.__name__}": _of_data(function) for function in _MATH}
)
"""The functions by their dotted path in imports."""
