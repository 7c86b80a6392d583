"""Methods that expressions may call, by the exact type of their object."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from xacro import YamlDictWrapper, YamlListWrapper

from checker.formats.xacro.expression.bounds import Budget, RefusedExpression
from checker.formats.xacro.expression.builtins import hashable, pairs, sorting_key
from checker.formats.xacro.expression.format import format_method
from checker.formats.xacro.expression.operators import spend_on_search
from checker.formats.xacro.expression.values import (
    LAZY,
    PLAIN,
    consumed,
    plain,
    spend_on_keys,
    type_label,
    weigh,
)

# Methods of text that expressions may call.


TextMethod = Callable[..., Any]
_SHORT = 40
_WHOLE = (
    *("capitalize", "casefold", "isalnum", "isalpha", "isascii", "isdecimal", "isdigit"),
    *("isidentifier", "islower", "isnumeric", "isspace", "istitle", "isupper", "lower", "lstrip"),
    *("removeprefix", "removesuffix", "rstrip", "strip", "swapcase", "title", "upper"),
)
_SEARCHING = (
    *("count", "endswith", "find", "index", "partition", "rfind", "rindex", "rpartition"),
    "startswith",
)
_WIDENING = ("center", "ljust", "rjust", "zfill")
_SPLITTING = ("rsplit", "split", "splitlines")


def _length(value: Any) -> int:
    return len(value) if type(value) is str else _SHORT


def _sought(arguments: tuple[Any, ...]) -> int:
    """Return how many characters are sought: of one text, or of several in a tuple."""
    first = arguments[0] if arguments else ""
    return sum(map(_length, first)) if type(first) is tuple else _length(first)


def _whole(name: str) -> TextMethod:
    def method(budget: Budget, text: str, *arguments: Any) -> Any:
        budget.spend_on_search(4 * len(text), _sought(arguments))
        return getattr(text, name)(*map(plain, arguments))

    return method


def _splitting(name: str) -> TextMethod:
    def method(budget: Budget, text: str, *arguments: Any, **named: Any) -> Any:
        separator = (*arguments, named.get("sep"))[:1]
        budget.spend(1 + len(text) // 2)
        budget.spend_on_search(len(text), _sought(separator))
        return getattr(text, name)(
            *map(plain, arguments), **{key: plain(value) for key, value in named.items()}
        )

    return method


def _widening(name: str) -> TextMethod:
    def method(budget: Budget, text: str, *arguments: Any) -> str:
        width = arguments[0] if arguments and type(arguments[0]) is int else 0
        budget.spend_on_text(max(width, len(text)))
        return str(getattr(text, name)(*map(plain, arguments)))

    return method


def _expandtabs(budget: Budget, text: str, tabsize: Any = 8) -> str:
    size = max(tabsize, 0) if type(tabsize) is int else 0
    budget.spend_on_text(len(text) + text.count("\t") * size)
    return text.expandtabs(plain(tabsize))


def _replace(budget: Budget, text: str, *arguments: Any) -> str:
    if len(arguments) >= 2 and type(arguments[0]) is str and type(arguments[1]) is str:
        old, new = arguments[:2]
        budget.spend_on_search(len(text), len(old))
        budget.spend_on_text(len(text) + text.count(old) * len(new))
    return text.replace(*map(plain, arguments))


def _join(budget: Budget, text: str, *arguments: Any) -> str:
    values = [list(argument) if type(argument) in LAZY else argument for argument in arguments]
    for value in values:
        parts = consumed(value, budget)
        if hasattr(type(parts), "__len__"):
            length = sum(map(_length, parts)) + len(text) * len(parts)
            budget.spend_on_text(length)
    return text.join(*values)


def _format(budget: Budget, text: str, *arguments: Any, **named: Any) -> str:
    return format_method(text, arguments, named, budget)


TEXTS: Mapping[str, TextMethod] = MappingProxyType(
    {name: _whole(name) for name in (*_WHOLE, *_SEARCHING)}
    | {name: _splitting(name) for name in _SPLITTING}
    | {name: _widening(name) for name in _WIDENING}
    | {"expandtabs": _expandtabs, "format": _format, "join": _join, "replace": _replace}
)
"""The methods by name."""


Method = Callable[..., Any]
"""Called with the budget, the value that it belongs to, and the arguments."""


def _reading(name: str) -> Method:
    """Return a method that looks at its value alone."""
    return lambda budget, value, *arguments: (
        budget.spend(),
        getattr(value, name)(*map(plain, arguments)),
    )[1]


def _copying(name: str) -> Method:
    def method(budget: Budget, value: Any, *arguments: Any) -> Any:
        budget.spend_on_copy(len(value))
        return getattr(value, name)(*map(plain, arguments))

    return method


def _searching(name: str) -> Method:
    def method(budget: Budget, value: Any, *arguments: Any) -> Any:
        for sought in arguments[:1]:
            spend_on_search(sought, value, budget)
        return getattr(value, name)(*map(plain, arguments))

    return method


def _looking_up(name: str) -> Method:
    """Return a method whose first argument is a key."""

    def method(budget: Budget, value: Any, *arguments: Any) -> Any:
        for key in arguments[:1]:
            weigh(key, budget)
            spend_on_keys([key], len(value), budget)
        return getattr(value, name)(*map(plain, arguments))

    return method


def _extend(budget: Budget, value: Any, *arguments: Any) -> Any:
    return value.extend(*(consumed(argument, budget) for argument in arguments))


def _sort(budget: Budget, value: Any, *, key: Any = None, reverse: Any = False) -> Any:
    return value.sort(key=sorting_key(budget, value, key), reverse=plain(reverse))


def _update(budget: Budget, value: Any, *arguments: Any, **named: Any) -> Any:
    entries = pairs(budget, arguments, len(value))
    return value.update(*entries, **{k: plain(v) for k, v in named.items()})


def _combining(name: str) -> Method:
    """Return a method of sets that takes other collections."""

    def method(budget: Budget, value: Any, *arguments: Any) -> Any:
        weigh(value, budget)
        others = [list(argument) if type(argument) in LAZY else argument for argument in arguments]
        sizes = len(value) + sum(len(other) for other in others if hasattr(type(other), "__len__"))
        for item in (value, *others):
            key = hashable(budget, item)
            if type(key) in PLAIN and hasattr(type(key), "__len__"):
                spend_on_keys(key, sizes, budget)
        return getattr(value, name)(*others)

    return method


_LIST: Mapping[str, Method] = MappingProxyType(
    {name: _reading(name) for name in ("append", "clear", "reverse")}
    | {name: _copying(name) for name in ("copy", "insert", "pop")}
    | {name: _searching(name) for name in ("count", "index", "remove")}
    | {"extend": _extend, "sort": _sort}
)
_DICT: Mapping[str, Method] = MappingProxyType(
    {name: _reading(name) for name in ("clear", "items", "keys", "popitem", "values")}
    | {name: _looking_up(name) for name in ("get", "pop", "setdefault")}
    | {"copy": _copying("copy"), "update": _update}
)
_COMBINING = (
    *("difference", "intersection", "isdisjoint", "issubset", "issuperset"),
    *("symmetric_difference", "union"),
)
_FROZENSET: Mapping[str, Method] = MappingProxyType(
    {name: _combining(name) for name in _COMBINING} | {"copy": _copying("copy")}
)
_UPDATING = (
    *("difference_update", "intersection_update", "symmetric_difference_update", "update"),
)
_SET: Mapping[str, Method] = MappingProxyType(
    {**_FROZENSET}
    | {name: _combining(name) for name in _UPDATING}
    | {name: _looking_up(name) for name in ("add", "discard", "remove")}
    | {name: _reading(name) for name in ("clear", "pop")}
)

METHODS: Mapping[type, Mapping[str, Method]] = MappingProxyType(
    {
        str: TEXTS,
        list: _LIST,
        YamlListWrapper: _LIST,
        tuple: {name: _searching(name) for name in ("count", "index")},
        range: {name: _searching(name) for name in ("count", "index")},
        dict: _DICT,
        YamlDictWrapper: _DICT,
        set: _SET,
        frozenset: _FROZENSET,
        float: {"is_integer": _reading("is_integer")},
        int: {"bit_length": _reading("bit_length")},
    }
)
TAKING_A_KEY: Mapping[Method, frozenset[int | str]] = MappingProxyType({_sort: frozenset({"key"})})
"""Methods with arguments that may be functions."""


def method_of(value: Any, name: str) -> Method:
    """Return a method of a value.

    Raises:
        AttributeError: Values of that type have none of that name.
        RefusedExpression: It is not in the language.
    """
    kind = type(value)
    method = METHODS.get(kind, {}).get(name)
    if method is not None:
        return method
    if kind in PLAIN and not hasattr(kind, name):
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")
    raise RefusedExpression(f"the method .{name} of {type_label(value)}")
