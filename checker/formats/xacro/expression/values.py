"""The values of the language, distinguished by their exact type, and their sizes."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import date, datetime
from types import GeneratorType, NoneType
from typing import Any

from xacro import YamlDictWrapper, YamlListWrapper

from checker.formats.xacro.expression.bounds import (
    LEVELS_LIMIT,
    Budget,
    ExpressionLimit,
    RefusedExpression,
)

NUMBERS = frozenset({int, float, bool})
SCALARS = NUMBERS | {str, NoneType, range, date, datetime}
"""Types of values that contain no others; dates come from YAML alone."""
MAPPINGS = frozenset({dict, YamlDictWrapper})
_VIEWS = frozenset({type({}.keys()), type({}.values()), type({}.items())})
SEQUENCES = frozenset({list, YamlListWrapper, tuple})
HASHED = MAPPINGS | {set, frozenset}
COLLECTIONS = SEQUENCES | {set, frozenset} | _VIEWS
PLAIN = SCALARS | COLLECTIONS | MAPPINGS
"""Types of data: the possible items of a list, and values of an expression."""
SIZED = (COLLECTIONS | MAPPINGS) | {str, range}
LAZY: frozenset[type] = frozenset(
    {map, filter, zip, enumerate, GeneratorType, reversed}
    | {type(reversed([])), type(reversed({})), type(reversed({}.values()))}
    | {type(reversed({}.items())), type(reversed(range(0))), type(reversed(range(2**70)))}
)
"""Types of what yields its items one by one: it may be used up, but neither kept nor shown."""
_EASY_KEYS = frozenset({str, float, bool, NoneType})
_HASHED_BITS = 60


def type_label(value: Any) -> str:
    """Return what to call a value in a message."""
    return f"a value of type {type(value).__name__}"


def plain(value: Any) -> Any:
    """Return a value if it is data.

    Raises:
        RefusedExpression: It is not.
    """
    if type(value) not in PLAIN:
        raise RefusedExpression(f"{type_label(value)} as data")
    return value


def weigh(value: Any, budget: Budget) -> int:
    """Take a step for everything in a value, as often as showing it would show it.

    Returns:
        How many steps.

    Raises:
        RefusedExpression: It contains something other than data.
        ExpressionLimit: It is too large or too deep, or contains itself.
    """
    taken = 0
    level: Iterable[Any] = (value,)
    for _ in range(LEVELS_LIMIT):
        below: list[Any] = []
        steps = 0
        for item in level:
            kind = type(item)
            if kind is str:
                steps += 1 + len(item) // 64
            elif kind is int:
                steps += 1 + item.bit_length() // 64
            elif kind in SCALARS:
                steps += 1
            else:
                if kind in HASHED:
                    spend_on_keys(item, len(item), budget)
                below_it = _contents(item)
                budget.spend(len(below_it))
                taken += len(below_it)
                below += below_it
        budget.spend(steps)
        taken += steps
        if not below:
            return taken
        level = below
    raise ExpressionLimit(f"has more than {LEVELS_LIMIT} lists within lists")


def _contents(value: Any) -> list[Any]:
    kind = type(value)
    if kind in MAPPINGS:
        return [*dict.keys(value), *dict.values(value)]
    if kind is YamlListWrapper:
        return list.copy(value)
    if kind in COLLECTIONS:
        return list(value)
    raise RefusedExpression(f"{type_label(value)} as data")


def spend_on_keys(keys: Iterable[Any], size: int, budget: Budget) -> None:
    """Take the steps of looking up keys among so many others, as if all their hashes were equal."""
    hard = sum(map(_is_hard, keys))
    budget.spend(1 + hard * (size // 64))


def _is_hard(key: Any) -> bool:
    """Return whether one can choose keys of that kind whose hashes are equal."""
    kind = type(key)
    if kind is int:
        return int(key).bit_length() > _HASHED_BITS
    return kind not in _EASY_KEYS


def consumed(value: Any, budget: Budget) -> Any:
    """Return what a function may take all items of; those of a lazy value are paid one by one.

    What has no items is returned too: Python states best what is wrong with it.
    """
    kind = type(value)
    if kind in SIZED:
        budget.spend(1 + len(value))
    elif kind not in LAZY and kind not in PLAIN:
        raise RefusedExpression(f"{type_label(value)} as data")
    return value


def counted(value: Any, budget: Budget) -> Any:
    """Yield the items of a value, a step for each."""
    for item in value:
        budget.spend()
        yield item
