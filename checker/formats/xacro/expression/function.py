"""A function of the language: a name, and the effect of a call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from checker.base.record import Record
from checker.formats.xacro.expression.bounds import Budget, RefusedExpression
from checker.formats.xacro.expression.values import plain, weigh

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


def unavailable_function(name: str) -> Function:
    """Return what represents a function that the language does not have."""

    def work(*_: Any, **__: Any) -> Any:
        raise RefusedExpression(f"the function {name}()")

    return Function(name, work)


def functions(works: Sequence[tuple[str, Work]]) -> dict[str, Function]:
    """Return functions by their names."""
    return {name: Function(name, work) for name, work in works}
