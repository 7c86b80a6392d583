"""Evaluates an expression: the one way in."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import islice
from types import MappingProxyType
from typing import Any

from checker.formats.xacro.expression.bounds import (
    LEVELS_LIMIT,
    Allowance,
    Budget,
    ExpressionLimit,
    RefusedExpression,
)
from checker.formats.xacro.expression.calls import CALLS
from checker.formats.xacro.expression.interpreter import Handler, Interpreter, Names, Scope
from checker.formats.xacro.expression.nodes import NODES, OPERATIONS, add_key
from checker.formats.xacro.expression.values import weigh

# What comprehensions and generator expressions mean.


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
    scope = Scope((name for clause in clauses for name in _names(clause.target)), outer)
    return scope, _rounds(run, clauses, first, scope)


def _names(target: ast.expr) -> Iterator[str]:
    if type(target) is ast.Name:
        yield target.id
    elif type(target) in (ast.Tuple, ast.List):
        for elt in target.elts:  # type: ignore[attr-defined]
            yield from _names(elt)
    else:
        raise RefusedExpression("a comprehension that binds other than names")


def _bind(run: Interpreter, target: ast.expr, item: Any, scope: Scope) -> None:
    if type(target) is ast.Name:
        scope.values[target.id] = item
        return
    targets: list[ast.expr] = target.elts  # type: ignore[attr-defined]
    wanted = len(targets)
    try:
        values = list(islice(item, wanted + 1))
    except TypeError:
        raise TypeError(f"cannot unpack non-iterable {type(item).__name__} object") from None
    run.budget.spend(len(values))
    if len(values) > wanted:
        raise ValueError(f"too many values to unpack (expected {wanted})")
    if len(values) < wanted:
        raise ValueError(f"not enough values to unpack (expected {wanted}, got {len(values)})")
    for part, value in zip(targets, values, strict=True):
        _bind(run, part, value, scope)


def _list(run: Interpreter, node: ast.ListComp, outer: Scope | None) -> list[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    return [run.data(node.elt, scope) for _ in rounds]


def _generator(run: Interpreter, node: ast.GeneratorExp, outer: Scope | None) -> Iterator[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    return (run.data(node.elt, scope) for _ in rounds)


def _set(run: Interpreter, node: ast.SetComp, outer: Scope | None) -> set[Any]:
    scope, rounds = _begin(run, node.generators, outer)
    result: set[Any] = set()
    for _ in rounds:
        result.add(add_key(run, run.data(node.elt, scope), result))
    return result


def _dict(run: Interpreter, node: ast.DictComp, outer: Scope | None) -> dict[Any, Any]:
    scope, rounds = _begin(run, node.generators, outer)
    result: dict[Any, Any] = {}
    for _ in rounds:
        key = add_key(run, run.data(node.key, scope), result)
        result[key] = run.data(node.value, scope)
    return result


COMPREHENSIONS: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {
        ast.ListComp: _list,
        ast.SetComp: _set,
        ast.DictComp: _dict,
        ast.GeneratorExp: _generator,
    }
)
"""The functions by type of node."""


# Reads the text of an expression into Python's syntax tree, and looks over it.


LENGTH_LIMIT = 20_000
"""Characters of one expression."""
_KEPT_LENGTH = 200
"""Characters of an expression whose tree is kept: a larger one comes seldom twice."""
_KEPT = 1_000
_NODES: frozenset[type[ast.AST]] = frozenset(
    {
        *(ast.Constant, ast.Name, ast.Attribute, ast.Subscript, ast.Slice, ast.Starred),
        *(ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.IfExp, ast.Call, ast.keyword),
        *(ast.List, ast.Tuple, ast.Set, ast.Dict, ast.JoinedStr, ast.FormattedValue),
        *(ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp, ast.comprehension),
        *(ast.Lambda, ast.arguments, ast.arg),
    }
)
_FORMS: dict[type[ast.AST], str] = {
    ast.NamedExpr: "an assignment (:=)",
    ast.Await: "await",
    ast.Yield: "yield",
    ast.YieldFrom: "yield from",
}
_SIGNS = (ast.operator, ast.unaryop, ast.boolop, ast.cmpop, ast.expr_context)


def parse(text: str) -> ast.expr:
    """Return the syntax tree of an expression; it is shared, and not to be changed.

    Raises:
        RefusedExpression: It uses a construct or a name that the language does not have.
        ExpressionLimit: It is too long or nested too deeply.
        SyntaxError, ValueError: It is no expression.
    """
    text = text.strip()
    if len(text) > LENGTH_LIMIT:
        raise ExpressionLimit(f"has {len(text)} characters, more than {LENGTH_LIMIT}")
    return _kept(text) if len(text) <= _KEPT_LENGTH else _parsed(text)


def _parsed(text: str) -> ast.expr:
    try:
        tree = ast.parse(text, "<expression>", "eval").body
    except (RecursionError, MemoryError):
        raise ExpressionLimit("is nested too deeply") from None
    waiting: list[tuple[ast.AST, int]] = [(tree, 0)]
    while waiting:
        node, level = waiting.pop()
        if level > LEVELS_LIMIT:
            raise ExpressionLimit(f"is nested more than {LEVELS_LIMIT} levels deep")
        _check(node)
        for child in ast.iter_child_nodes(node):
            # a + b + c leans to the left, and is evaluated without going deeper.
            leaning = isinstance(node, ast.BinOp) and child is node.left
            if not isinstance(child, _SIGNS):
                waiting.append((child, level if leaning else level + 1))
    return tree


_kept = lru_cache(_KEPT)(_parsed)


def _check(node: ast.AST) -> None:
    if type(node) not in _NODES:
        form = _FORMS.get(type(node), type(node).__name__)
        raise RefusedExpression(form)
    for name in (getattr(node, field, None) for field in ("id", "attr", "arg")):
        if type(name) is str and name.startswith("__"):
            raise RefusedExpression(f"the name {name[:40]!r}")
    if isinstance(node, ast.Constant) and type(node.value) in (complex, bytes, type(...)):
        raise RefusedExpression(f"the constant {str(node.value)[:40]}")
    if isinstance(node, ast.comprehension) and node.is_async:
        raise RefusedExpression("async")


HANDLERS: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {**NODES, **OPERATIONS, **CALLS, **COMPREHENSIONS}
)
"""The whole language: what each type of node means."""


def evaluate(text: str, names: Names, allowance: Allowance | None = None) -> Any:
    """Return the value of an expression, which is data.

    Args:
        text: The text as written, without `${` and `}`.
        names: What its names represent: data, functions, or namespaces of these.
        allowance: Steps that are left to all expressions of a file.

    Raises:
        RefusedExpression: It uses what the language does not have.
        ExpressionLimit: It takes more than it may.
        Exception: What Python raises for it.
    """
    tree = parse(text)
    budget = Budget(allowance)
    try:
        result = Interpreter(names, budget, HANDLERS).value(tree, None)
        weigh(result, budget)
    finally:
        budget.close()
    return result
