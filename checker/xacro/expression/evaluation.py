"""Evaluates an expression: the one way in."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from checker.xacro.expression.bounds import Allowance, Budget
from checker.xacro.expression.calls import CALLS
from checker.xacro.expression.comprehensions import COMPREHENSIONS
from checker.xacro.expression.interpreter import Handler, Interpreter, Names
from checker.xacro.expression.nodes import NODES
from checker.xacro.expression.operations import OPERATIONS
from checker.xacro.expression.parsing import parse
from checker.xacro.expression.values import weigh

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
