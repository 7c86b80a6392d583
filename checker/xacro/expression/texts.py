"""Methods of text that expressions may call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from checker.xacro.expression.bounds import Budget
from checker.xacro.expression.formatting import format_method
from checker.xacro.expression.values import LAZY, consumed, plain

Method = Callable[..., Any]
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


def _whole(name: str) -> Method:
    def method(budget: Budget, text: str, *arguments: Any) -> Any:
        budget.spend_on_search(4 * len(text), _sought(arguments))
        return getattr(text, name)(*map(plain, arguments))

    return method


def _splitting(name: str) -> Method:
    def method(budget: Budget, text: str, *arguments: Any, **named: Any) -> Any:
        separator = (*arguments, named.get("sep"))[:1]
        budget.spend(1 + len(text) // 2)
        budget.spend_on_search(len(text), _sought(separator))
        return getattr(text, name)(
            *map(plain, arguments), **{key: plain(value) for key, value in named.items()}
        )

    return method


def _widening(name: str) -> Method:
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
    found = [list(each) if type(each) in LAZY else each for each in arguments]
    for each in found:
        parts = consumed(each, budget)
        if hasattr(type(parts), "__len__"):
            length = sum(map(_length, parts)) + len(text) * len(parts)
            budget.spend_on_text(length)
    return text.join(*found)


def _format(budget: Budget, text: str, *arguments: Any, **named: Any) -> str:
    return format_method(text, arguments, named, budget)


TEXTS: Mapping[str, Method] = MappingProxyType(
    {name: _whole(name) for name in (*_WHOLE, *_SEARCHING)}
    | {name: _splitting(name) for name in _SPLITTING}
    | {name: _widening(name) for name in _WIDENING}
    | {"expandtabs": _expandtabs, "format": _format, "join": _join, "replace": _replace}
)
"""By name."""
