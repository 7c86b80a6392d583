"""Functions of Python that expressions may call."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from checker.formats.xacro.expression.bounds import (
    Budget,
    RefusedExpression,
    check_bits,
    check_width,
)
from checker.formats.xacro.expression.format import text_of
from checker.formats.xacro.expression.function import Function, Work, unavailable_function, weighed
from checker.formats.xacro.expression.operators import BINARY, apply_binary
from checker.formats.xacro.expression.values import (
    LAZY,
    MAPPINGS,
    NUMBERS,
    SEQUENCES,
    consumed,
    counted,
    plain,
    spend_on_keys,
    type_label,
    weigh,
)

_ADD = next(kind for kind in BINARY if kind.__name__ == "Add")


def length(budget: Budget, *arguments: Any) -> Any:
    """Do what `len` does."""
    budget.spend()
    return len(*arguments)


def text(budget: Budget, *arguments: Any) -> str:
    """Do what `str` does with one value."""
    if len(arguments) > 1:
        raise RefusedExpression("str() of more than one value")
    return text_of(arguments[0], budget) if arguments else ""


def shown(budget: Budget, value: Any) -> str:
    """Do what `repr` does."""
    weigh(value, budget)
    return repr(value)


def whole_number(budget: Budget, *arguments: Any, **named: Any) -> int:
    """Do what `int` does, within the bounds of whole numbers."""
    result = int(weighed(int)(budget, *arguments, **named))
    check_bits(result.bit_length())
    return result


def rounded(budget: Budget, number: Any, ndigits: Any = None) -> Any:
    """Do what `round` does."""
    weigh(number, budget)
    if type(ndigits) is int:
        check_width(abs(ndigits))
    return round(plain(number), plain(ndigits))


def listed(budget: Budget, *arguments: Any) -> list[Any]:
    """Do what `list` does."""
    return list(*(consumed(argument, budget) for argument in arguments))


def tupled(budget: Budget, *arguments: Any) -> tuple[Any, ...]:
    """Do what `tuple` does."""
    return tuple(*(consumed(argument, budget) for argument in arguments))


def keyed(kind: type) -> Work:
    """Return what `set` and `frozenset` do."""

    def work(budget: Budget, *arguments: Any) -> Any:
        values = [hashable(budget, argument) for argument in arguments]
        return kind(*values)

    return work


def hashable(budget: Budget, items: Any) -> Any:
    """Return items that are going to be keys, once their hashes are paid for."""
    if type(items) in LAZY:
        items = list(items)
    weigh(items, budget)
    consumed(items, budget)
    if hasattr(type(items), "__len__"):
        spend_on_keys(items, len(items), budget)
    return items


def mapping(kind: type) -> Work:
    """Return what `dict` does."""

    def work(budget: Budget, *arguments: Any, **named: Any) -> Any:
        return kind(*pairs(budget, arguments), **{k: plain(v) for k, v in named.items()})

    return work


def pairs(budget: Budget, arguments: tuple[Any, ...], among: int = 0) -> tuple[Any, ...]:
    """Return the items of a dictionary, once the hashes of its keys are paid for.

    Args:
        budget: The budget to take the steps from.
        arguments: The arguments of `dict` or `update` without the named ones.
        among: The number of keys of the dictionary.
    """
    values = tuple(list(argument) if type(argument) in LAZY else argument for argument in arguments)
    for value in values:
        weigh(value, budget)
        keys = value if type(value) in MAPPINGS else []
        if type(consumed(value, budget)) in SEQUENCES:
            keys = [pair[0] for pair in value if type(pair) in SEQUENCES and pair]
        spend_on_keys(keys, among + len(keys), budget)
    return values


def in_order(budget: Budget, items: Any, /, *, key: Any = None, reverse: Any = False) -> list[Any]:
    """Do what `sorted` does."""
    values = listed(budget, items)
    return sorted(values, key=sorting_key(budget, values, key), reverse=plain(reverse))


def sorting_key(budget: Budget, items: list[Any], key: Any) -> Any:
    """Take the steps of comparing items with one another; return a key that takes those of its own.

    Args:
        budget: The budget to take the steps from.
        items: The items to sort.
        key: What to sort them by, or None.
    """
    rounds = 1 + len(items).bit_length() // 4
    budget.spend(rounds * weigh(items, budget))
    return paid(budget, key, rounds)


def paid(budget: Budget, key: Any, rounds: int = 1) -> Any:
    """Return a key function that takes the steps of comparing what it returns, so many times."""
    if not callable(key):
        return key

    def called(item: Any) -> Any:
        result = key(item)
        budget.spend(rounds * weigh(result, budget))
        return result

    return called


def extreme(native: Any) -> Work:
    """Return what `min` and `max` do."""

    def work(budget: Budget, *arguments: Any, key: Any = None, **named: Any) -> Any:
        values = arguments
        if len(arguments) == 1 and type(arguments[0]) in LAZY:
            values = (list(arguments[0]),)
        for value in values:
            weigh(consumed(value, budget), budget)
        return native(*values, key=paid(budget, key), **named)

    return work


def total(budget: Budget, items: Any, /, start: Any = 0) -> Any:
    """Do what `sum` does."""
    values = listed(budget, items)
    if all(type(value) in NUMBERS or type(value) is str for value in (*values, start)):
        weigh(values, budget)
        return sum(values, start)
    result = plain(start)
    for value in values:
        result = apply_binary(_ADD, result, value, budget)
    return result


def decided(native: Any) -> Work:
    """Return what `any` and `all` do."""
    return lambda budget, items: native(consumed(items, budget))


def mapped(budget: Budget, function: Any, /, *items: Any) -> Any:
    """Do what `map` does."""
    return map(function, *(consumed(item, budget) for item in items))


def filtered(budget: Budget, function: Any, items: Any, /) -> Any:
    """Do what `filter` does."""
    return filter(function, counted(consumed(items, budget), budget))


def zipped(budget: Budget, *items: Any, strict: Any = False) -> Any:
    """Do what `zip` does."""
    iterators = [counted(consumed(item, budget), budget) for item in items]
    return zip(*iterators, strict=bool(strict))


def numbered(budget: Budget, items: Any, start: Any = 0) -> Any:
    """Do what `enumerate` does."""
    return enumerate(counted(consumed(items, budget), budget), plain(start))


def backwards(budget: Budget, items: Any, /) -> Any:
    """Do what `reversed` does."""
    return reversed(consumed(items, budget))


def is_of(budget: Budget, value: Any, kinds: Any, /) -> bool:
    """Do what `isinstance` does; the call passes types as the functions of their names."""
    budget.spend()
    if type(value) in LAZY:
        raise RefusedExpression(type_label(value))
    return isinstance(value, kinds)


_TYPES: Mapping[str, tuple[type, Work]] = MappingProxyType(
    {
        "int": (int, whole_number),
        "float": (float, weighed(float)),
        "bool": (bool, weighed(bool)),
        "str": (str, text),
        "list": (list, listed),
        "tuple": (tuple, tupled),
        "dict": (dict, mapping(dict)),
        "set": (set, keyed(set)),
        "frozenset": (frozenset, keyed(frozenset)),
    }
)
_WORKS: Mapping[str, Work] = MappingProxyType(
    {
        "len": length,
        "round": rounded,
        "abs": weighed(abs),
        "divmod": weighed(divmod),
        "ord": weighed(ord),
        "repr": shown,
        "sum": total,
        "any": decided(any),
        "all": decided(all),
        "zip": zipped,
        "enumerate": numbered,
        "reversed": backwards,
        "range": weighed(range),
        "isinstance": is_of,
    }
)
_OTHERS = ("complex", "hash", "issubclass", "slice", "type", "vars")
"""Other names that xacro offers and no description of a robot needs."""

FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {name: Function(name, work, stands_for=kind) for name, (kind, work) in _TYPES.items()}
    | {name: Function(name, work) for name, work in _WORKS.items()}
    | {name: unavailable_function(name) for name in _OTHERS}
    | {
        "map": Function("map", mapped, frozenset({0})),
        "filter": Function("filter", filtered, frozenset({0})),
        "sorted": Function("sorted", in_order, frozenset({"key"})),
        "min": Function("min", extreme(min), frozenset({"key"})),
        "max": Function("max", extreme(max), frozenset({"key"})),
    }
)
"""The functions by name."""
