"""Functions of Python that expressions may call."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from checker.base.record import Record
from checker.formats.xacro.expression.bounds import (
    Budget,
    RefusedExpression,
    check_bits,
    check_width,
)
from checker.formats.xacro.expression.format import text_of
from checker.formats.xacro.expression.operators import apply_binary
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

Work = Callable[..., Any]
"""Called with the budget, the arguments and the named arguments."""


class Function(Record):
    """Function as the value of a name; an expression calls it, or passes it to another function.

    Attributes:
        name: The name as an expression writes it.
        work: What it does.
        takes: Places and names of arguments that may be functions.
        stands_for: The type that `isinstance` may test for by this name.
    """

    name: str
    work: Work
    takes: frozenset[int | str] = frozenset()
    stands_for: type | None = None


def counting(function: Function, budget: Budget) -> Callable[..., Any]:
    """Return a function as Python's own functions call it, such as `map`; each call is a step."""

    def called(*arguments: Any) -> Any:
        budget.spend()
        return plain(function.work(budget, *map(plain, arguments)))

    return called


def weighed(native: Callable[..., Any]) -> Work:
    """Return the work of a function of Python that only reads its arguments."""

    def work(budget: Budget, *arguments: Any, **named: Any) -> Any:
        for value in (*arguments, *named.values()):
            weigh(value, budget)
        return native(*arguments, **named)

    return work


def consuming(native: Callable[..., Any]) -> Work:
    """Return the work of a function of Python that takes all items of its arguments."""
    return lambda budget, *arguments: native(*_consumed(arguments, budget))


def _consumed(arguments: Iterable[Any], budget: Budget) -> Iterator[Any]:
    return (consumed(argument, budget) for argument in arguments)


def unavailable_function(name: str) -> Function:
    """Return what represents a function that the language does not have."""

    def work(*_: Any, **__: Any) -> Any:
        raise RefusedExpression(f"the function {name}()")

    return Function(name, work)


def functions(works: Sequence[tuple[str, Work]]) -> dict[str, Function]:
    """Return functions by their names."""
    return {name: Function(name, work) for name, work in works}


def length(budget: Budget, *arguments: Any) -> int:
    """Do what `len` does."""
    budget.spend()
    return len(*arguments)


def text(budget: Budget, *arguments: Any) -> str:
    """Do what `str` does with one value."""
    if len(arguments) > 1:
        raise RefusedExpression("str() of more than one value")
    return text_of(arguments[0], budget) if arguments else ""


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
    return list(*_consumed(arguments, budget))


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
        result = apply_binary(ast.Add, result, value, budget)
    return result


def zipped(budget: Budget, *items: Any, strict: Any = False) -> Any:
    """Do what `zip` does."""
    iterators = [counted(consumed(item, budget), budget) for item in items]
    return zip(*iterators, strict=bool(strict))


def is_of(budget: Budget, value: Any, kinds: Any, /) -> bool:
    """Do what `isinstance` does; the call passes types as the functions of their names."""
    budget.spend()
    if type(value) in LAZY:
        raise RefusedExpression(type_label(value))
    return isinstance(value, kinds)


_TYPES: Mapping[str, tuple[type, Work]] = {
    "int": (int, whole_number),
    "float": (float, weighed(float)),
    "bool": (bool, weighed(bool)),
    "str": (str, text),
    "list": (list, listed),
    "tuple": (tuple, consuming(tuple)),
    "dict": (dict, mapping(dict)),
    "set": (set, keyed(set)),
    "frozenset": (frozenset, keyed(frozenset)),
}
_WORKS: Mapping[str, Work] = {
    "len": length,
    "round": rounded,
    "abs": weighed(abs),
    "divmod": weighed(divmod),
    "ord": weighed(ord),
    "repr": weighed(repr),
    "sum": total,
    "any": consuming(any),
    "all": consuming(all),
    "zip": zipped,
    "enumerate": lambda budget, items, start=0: enumerate(
        counted(consumed(items, budget), budget), plain(start)
    ),
    "reversed": consuming(reversed),
    "range": weighed(range),
    "isinstance": is_of,
}
_OF_FUNCTIONS: Mapping[str, tuple[Work, int | str]] = {
    "map": (lambda budget, function, /, *items: map(function, *_consumed(items, budget)), 0),
    "filter": (
        lambda budget, function, items, /: filter(
            function, counted(consumed(items, budget), budget)
        ),
        0,
    ),
    "sorted": (in_order, "key"),
    "min": (extreme(min), "key"),
    "max": (extreme(max), "key"),
}
_OTHERS = ("complex", "hash", "issubclass", "slice", "type", "vars")
"""Other names that xacro offers and no description of a robot needs."""

FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {name: Function(name, work, stands_for=kind) for name, (kind, work) in _TYPES.items()}
    | {name: Function(name, work) for name, work in _WORKS.items()}
    | {name: Function(name, work, frozenset({at})) for name, (work, at) in _OF_FUNCTIONS.items()}
    | {name: unavailable_function(name) for name in _OTHERS}
)
"""The functions by name."""
