"""Evaluates an expression: the one way in."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from checker.expand.xacro.expression.bounds import (
    LEVELS_LIMIT,
    Allowance,
    Budget,
    ExpressionLimit,
    RefusedExpression,
)
from checker.expand.xacro.expression.calls import CALLS
from checker.expand.xacro.expression.comprehensions import COMPREHENSIONS
from checker.expand.xacro.expression.interpreter import Handler, Interpreter, Names
from checker.expand.xacro.expression.nodes import NODES, OPERATIONS
from checker.expand.xacro.expression.values import weigh

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
_SAID: dict[type[ast.AST], str] = {
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
        said = _SAID.get(type(node), type(node).__name__)
        raise RefusedExpression(said)
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
        text: As written, without `${` and `}`.
        names: What its names stand for: data, functions, or namespaces of these.
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
