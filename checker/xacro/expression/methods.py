"""Methods that expressions may call, by the exact type of what they belong to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from xacro import YamlDictWrapper, YamlListWrapper

from checker.xacro.expression.bounds import Budget, RefusedExpression
from checker.xacro.expression.builtin import hashable, pairs, sorting_key
from checker.xacro.expression.operators import spend_on_search
from checker.xacro.expression.texts import TEXTS
from checker.xacro.expression.values import (
    LAZY,
    PLAIN,
    called,
    consumed,
    plain,
    spend_on_keys,
    weigh,
)

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
    return value.extend(*(consumed(each, budget) for each in arguments))


def _sort(budget: Budget, value: Any, *, key: Any = None, reverse: Any = False) -> Any:
    return value.sort(key=sorting_key(budget, value, key), reverse=plain(reverse))


def _update(budget: Budget, value: Any, *arguments: Any, **named: Any) -> Any:
    found = pairs(budget, arguments, len(value))
    return value.update(*found, **{k: plain(v) for k, v in named.items()})


def _combining(name: str) -> Method:
    """Return a method of sets that takes other collections."""

    def method(budget: Budget, value: Any, *arguments: Any) -> Any:
        weigh(value, budget)
        others = [list(each) if type(each) in LAZY else each for each in arguments]
        sizes = len(value) + sum(len(each) for each in others if hasattr(type(each), "__len__"))
        for each in (value, *others):
            found = hashable(budget, each)
            if type(found) in PLAIN and hasattr(type(found), "__len__"):
                spend_on_keys(found, sizes, budget)
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
    found = METHODS.get(kind, {}).get(name)
    if found is not None:
        return found
    if kind in PLAIN and not hasattr(kind, name):
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")
    raise RefusedExpression(f"the method .{name} of {called(value)}")
