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

Method = Callable[..., Any]
"""Called with the budget, the value that it belongs to, and the arguments."""
Cost = Callable[[Budget, Any, tuple[Any, ...]], None]
"""Takes the steps of a method from the budget, by the value and the arguments, `sep` among them."""
_SHORT = 40


def _paid(cost: Cost, names: str) -> dict[str, Method]:
    """Return methods of Python by name, each with its steps paid before it is called."""
    return {name: _paid_method(cost, name) for name in names.split()}


def _paid_method(cost: Cost, name: str) -> Method:
    def method(budget: Budget, value: Any, *arguments: Any, **named: Any) -> Any:
        sought = (named["sep"],) if "sep" in named else ()
        cost(budget, value, (*arguments, *sought))
        values = {key: plain(item) for key, item in named.items()}
        return getattr(value, name)(*map(plain, arguments), **values)

    return method


# Methods of text.


def _length(value: Any) -> int:
    return len(value) if type(value) is str else _SHORT


def _sought(arguments: tuple[Any, ...]) -> int:
    """Return how many characters are sought: of one text, or of several in a tuple."""
    first = arguments[0] if arguments else ""
    return sum(map(_length, first)) if type(first) is tuple else _length(first)


def _whole(budget: Budget, text: str, arguments: tuple[Any, ...]) -> None:
    budget.spend_on_search(4 * len(text), _sought(arguments))


def _splitting(budget: Budget, text: str, arguments: tuple[Any, ...]) -> None:
    budget.spend(1 + len(text) // 2)
    budget.spend_on_search(len(text), _sought(arguments or (None,)))


def _widening(budget: Budget, text: str, arguments: tuple[Any, ...]) -> None:
    width = arguments[0] if arguments and type(arguments[0]) is int else 0
    budget.spend_on_text(max(width, len(text)))


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


_TEXT: Mapping[str, Method] = {
    **_paid(
        _whole,
        "capitalize casefold count endswith find index isalnum isalpha isascii isdecimal isdigit "
        "isidentifier islower isnumeric isspace istitle isupper lower lstrip partition "
        "removeprefix removesuffix rfind rindex rpartition rstrip startswith strip swapcase title "
        "upper",
    ),
    **_paid(_splitting, "rsplit split splitlines"),
    **_paid(_widening, "center ljust rjust zfill"),
    "expandtabs": _expandtabs,
    "format": _format,
    "join": _join,
    "replace": _replace,
}


# Methods of collections.


def _reading(budget: Budget, _: Any, __: tuple[Any, ...]) -> None:
    budget.spend()


def _copying(budget: Budget, value: Any, _: tuple[Any, ...]) -> None:
    budget.spend_on_copy(len(value))


def _searching(budget: Budget, value: Any, arguments: tuple[Any, ...]) -> None:
    for sought in arguments[:1]:
        spend_on_search(sought, value, budget)


def _looking_up(budget: Budget, value: Any, arguments: tuple[Any, ...]) -> None:
    """Take the steps of a method whose first argument is a key."""
    for key in arguments[:1]:
        weigh(key, budget)
        spend_on_keys([key], len(value), budget)


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


_LIST: Mapping[str, Method] = {
    **_paid(_reading, "append clear reverse"),
    **_paid(_copying, "copy insert pop"),
    **_paid(_searching, "count index remove"),
    "extend": _extend,
    "sort": _sort,
}
_SEARCHED = _paid(_searching, "count index")
_DICT: Mapping[str, Method] = {
    **_paid(_reading, "clear items keys popitem values"),
    **_paid(_looking_up, "get pop setdefault"),
    **_paid(_copying, "copy"),
    "update": _update,
}
_COMBINING = (
    *("difference", "intersection", "isdisjoint", "issubset", "issuperset"),
    *("symmetric_difference", "union"),
)
_UPDATING = (
    *("difference_update", "intersection_update", "symmetric_difference_update", "update"),
)
_FROZENSET: Mapping[str, Method] = {
    **{name: _combining(name) for name in _COMBINING},
    **_paid(_copying, "copy"),
}
_SET: Mapping[str, Method] = {
    **_FROZENSET,
    **{name: _combining(name) for name in _UPDATING},
    **_paid(_looking_up, "add discard remove"),
    **_paid(_reading, "clear pop"),
}

METHODS: Mapping[type, Mapping[str, Method]] = MappingProxyType(
    {
        str: _TEXT,
        list: _LIST,
        YamlListWrapper: _LIST,
        tuple: _SEARCHED,
        range: _SEARCHED,
        dict: _DICT,
        YamlDictWrapper: _DICT,
        set: _SET,
        frozenset: _FROZENSET,
        float: _paid(_reading, "is_integer"),
        int: _paid(_reading, "bit_length"),
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
