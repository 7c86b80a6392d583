"""Evaluates the expressions of xacro files: `${…}` and `$(eval …)`.

xacro itself looks only at the outermost names of an expression. Here every name in it counts.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

LENGTH_LIMIT = 20_000
"""Characters of one expression."""


class RefusedExpression(Exception):
    """An expression that is not evaluated, and why."""


def evaluate(expression: str, names: Any, own: Mapping[str, Any] | None = None) -> Any:
    """Return the value of an expression.

    Args:
        expression: As written.
        names: A dictionary of global names; it gets no builtins.
        own: Names that count before those.

    Raises:
        RefusedExpression: It is too long, or reaches for what is hidden.
        Exception: Whatever evaluating it raises.
    """
    text = expression.strip()
    if len(text) > LENGTH_LIMIT:
        raise RefusedExpression(f"an expression of {len(text)} characters is not evaluated")
    tree = ast.parse(text, "<expression>", "eval")
    for node in ast.walk(tree):
        if hidden := _hidden(node):
            raise RefusedExpression(f"the name {hidden!r} may not be used")
    names.update(__builtins__={})
    return eval(compile(tree, "<expression>", "eval"), names, own)  # noqa: S307 - checked above


def _hidden(node: ast.AST) -> str:
    if isinstance(node, ast.Name) and node.id.startswith("__"):
        return node.id
    if isinstance(node, ast.Attribute) and (node.attr.startswith("_") or "func_" in node.attr):
        return node.attr
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and "__" in node.value:
        return node.value[:40]
    return ""
