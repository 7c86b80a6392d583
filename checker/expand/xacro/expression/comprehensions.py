"""What comprehensions and generator expressions mean."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from itertools import islice
from types import MappingProxyType
from typing import Any

from checker.expand.xacro.expression.bounds import RefusedExpression
from checker.expand.xacro.expression.interpreter import Handler, Interpreter, Scope
from checker.expand.xacro.expression.nodes import add_key


def _rounds(
    run: Interpreter, clauses: list[ast.comprehension], first: Iterator[Any], scope: Scope
) -> Iterator[None]:
    """Yield once for each round, with the names of that round bound."""
    clause, rest = clauses[0], clauses[1:]
    for item in first:
        run.budget.spend()
        _bind(run, clause.target, item, scope)
        if not all(run.value(condition, scope) for condition in clause.ifs):
            continue
        if rest:
            yield from _rounds(run, rest, iter(run.value(rest[0].iter, scope)), scope)
        else:
            yield


def _begin(
    run: Interpreter, clauses: list[ast.comprehension], outer: Scope | None
) -> tuple[Scope, Iterator[None]]:
    first = iter(run.value(clauses[0].iter, outer))
    scope = Scope((name for each in clauses for name in _names(each.target)), outer)
    return scope, _rounds(run, clauses, first, scope)


def _names(target: ast.expr) -> Iterator[str]:
    if type(target) is ast.Name:
        yield target.id
    elif type(target) in (ast.Tuple, ast.List):
        for each in target.elts:  # type: ignore[attr-defined]
            yield from _names(each)
    else:
        raise RefusedExpression("a comprehension that binds other than names")


def _bind(run: Interpreter, target: ast.expr, item: Any, scope: Scope) -> None:
    if type(target) is ast.Name:
        scope.values[target.id] = item
        return
    targets: list[ast.expr] = target.elts  # type: ignore[attr-defined]
    wanted = len(targets)
    try:
        found = list(islice(item, wanted + 1))
    except TypeError:
        raise TypeError(f"cannot unpack non-iterable {type(item).__name__} object") from None
    run.budget.spend(len(found))
    if len(found) > wanted:
        raise ValueError(f"too many values to unpack (expected {wanted})")
    if len(found) < wanted:
        raise ValueError(f"not enough values to unpack (expected {wanted}, got {len(found)})")
    for each, value in zip(targets, found, strict=True):
        _bind(run, each, value, scope)


def _list(run: Interpreter, node: ast.ListComp, outer: Scope | None) -> list[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    return [run.data(node.elt, scope) for _ in rounds]


def _generator(run: Interpreter, node: ast.GeneratorExp, outer: Scope | None) -> Iterator[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    return (run.data(node.elt, scope) for _ in rounds)


def _set(run: Interpreter, node: ast.SetComp, outer: Scope | None) -> set[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    made: set[Any] = set()
    for _ in rounds:
        made.add(add_key(run, run.data(node.elt, scope), made))
    return made


def _dict(run: Interpreter, node: ast.DictComp, outer: Scope | None) -> dict[Any, Any]:
    scope, rounds = _begin(run, node.generators, outer)
    made: dict[Any, Any] = {}
    for _ in rounds:
        key = add_key(run, run.data(node.key, scope), made)
        made[key] = run.data(node.value, scope)
    return made


COMPREHENSIONS: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {
        ast.ListComp: _list,
        ast.SetComp: _set,
        ast.DictComp: _dict,
        ast.GeneratorExp: _generator,
    }
)
"""By type of node."""
