"""What the nodes of a syntax tree mean that compute: operators, comparisons, conditions."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from checker.xacro.expression.interpreter import Handler, Interpreter, Scope
from checker.xacro.expression.operators import apply_binary, apply_comparison, apply_unary


def _binary(run: Interpreter, node: ast.BinOp, scope: Scope | None) -> Any:
    chain = [node]
    while type(chain[-1].left) is ast.BinOp:
        chain.append(chain[-1].left)
    left = run.value(chain[-1].left, scope)
    for each in reversed(chain):
        right = run.value(each.right, scope)
        left = apply_binary(type(each.op), left, right, run.budget)
    return left


def _unary(run: Interpreter, node: ast.UnaryOp, scope: Scope | None) -> Any:
    return apply_unary(type(node.op), run.value(node.operand, scope))


def _boolean(run: Interpreter, node: ast.BoolOp, scope: Scope | None) -> Any:
    ends_it = type(node.op) is ast.Or
    for operand in node.values[:-1]:
        value = run.value(operand, scope)
        if bool(value) is ends_it:
            return value
    return run.value(node.values[-1], scope)


def _compare(run: Interpreter, node: ast.Compare, scope: Scope | None) -> Any:
    left = run.value(node.left, scope)
    result: Any = True
    for operator, operand in zip(node.ops, node.comparators, strict=True):
        right = run.value(operand, scope)
        result = apply_comparison(type(operator), left, right, run.budget)
        if not result:
            break
        left = right
    return result


def _conditional(run: Interpreter, node: ast.IfExp, scope: Scope | None) -> Any:
    return run.value(node.body if run.value(node.test, scope) else node.orelse, scope)


OPERATIONS: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {
        ast.BinOp: _binary,
        ast.UnaryOp: _unary,
        ast.BoolOp: _boolean,
        ast.Compare: _compare,
        ast.IfExp: _conditional,
    }
)
"""By type of node."""
