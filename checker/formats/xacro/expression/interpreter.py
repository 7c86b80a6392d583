"""Evaluates a syntax tree node by node, in the scopes that its comprehensions and lambdas open."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol

from checker.formats.xacro.expression.bounds import Budget, RefusedExpression
from checker.formats.xacro.expression.values import plain

_UNBOUND = object()


class Names(Protocol):
    """Lookup of names that an expression does not bind itself."""

    def __getitem__(self, name: str, /) -> Any:
        """Return what a name represents, or raise KeyError."""


class Scope:
    """The names that a comprehension or a lambda binds."""

    def __init__(self, names: Iterable[str], outer: Scope | None) -> None:
        self.values: dict[str, Any] = dict.fromkeys(names, _UNBOUND)
        self.outer = outer


Handler = Callable[["Interpreter", Any, Scope | None], Any]


class Interpreter:
    """The evaluation of one expression.

    Attributes:
        budget: What it may still take.
    """

    def __init__(
        self, names: Names, budget: Budget, handlers: Mapping[type[ast.AST], Handler]
    ) -> None:
        self.budget = budget
        self._names = names
        self._handlers = handlers

    def value(self, node: ast.AST, scope: Scope | None) -> Any:
        """Return the value of a node: data, or what yields its items one by one."""
        self.budget.spend()
        handler = self._handlers.get(type(node))
        if handler is None:
            raise RefusedExpression(type(node).__name__)
        return handler(self, node, scope)

    def data(self, node: ast.AST, scope: Scope | None) -> Any:
        """Return the value of a node if it is data, such as an item of a list."""
        return plain(self.value(node, scope))

    def look_up(self, name: str, scope: Scope | None) -> Any:
        """Return what a name represents, be it data or a function.

        Raises:
            NameError: Nothing.
        """
        while scope is not None:
            if name in scope.values:
                value = scope.values[name]
                if value is _UNBOUND:
                    raise UnboundLocalError(
                        f"cannot access local variable {name!r} "
                        "where it is not associated with a value"
                    )
                return value
            scope = scope.outer
        try:
            return self._names[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None
