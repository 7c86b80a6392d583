"""Reads the text of an expression into Python's syntax tree, and looks over it."""

from __future__ import annotations

import ast
from functools import lru_cache

from checker.formats.xacro.expression.bounds import (
    LEVELS_LIMIT,
    ExpressionLimit,
    RefusedExpression,
)

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
