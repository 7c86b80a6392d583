"""Evaluation of the syntax nodes for values: constants, names, displays, subscripts."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

from xacro import NameSpace, YamlDictWrapper

from checker.formats.xacro.expression.bounds import RefusedExpression, check_bits
from checker.formats.xacro.expression.format import formatted
from checker.formats.xacro.expression.function import Function
from checker.formats.xacro.expression.interpreter import Handler, Interpreter, Scope
from checker.formats.xacro.expression.operators import (
    apply_binary,
    apply_comparison,
    apply_unary,
)
from checker.formats.xacro.expression.values import (
    LAZY,
    MAPPINGS,
    PLAIN,
    consumed,
    plain,
    spend_on_keys,
    type_label,
    weigh,
)

# What the nodes of a syntax tree mean that compute: operators, comparisons, conditions.


def _binary(run: Interpreter, node: ast.BinOp, scope: Scope | None) -> Any:
    chain = [node]
    while type(chain[-1].left) is ast.BinOp:
        chain.append(chain[-1].left)
    left = run.value(chain[-1].left, scope)
    for operation in reversed(chain):
        right = run.value(operation.right, scope)
        left = apply_binary(type(operation.op), left, right, run.budget)
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
"""The functions by type of node."""


_CONVERSIONS = {-1: "", 115: "s", 114: "r", 97: "a"}


def resolve(run: Interpreter, node: ast.AST, scope: Scope | None) -> Any:
    """Return what a node represents, which may be a function or a namespace."""
    if type(node) is ast.Name:
        return run.look_up(node.id, scope)
    if type(node) is ast.Attribute:
        return attribute(resolve(run, node.value, scope), node.attr)
    return run.value(node, scope)


def attribute(value: Any, name: str) -> Any:
    """Return what a dot leads to: a name of a namespace, or a key of what was read from YAML.

    Raises:
        AttributeError: It has no such key, or what it is has no attributes of that name.
        NameError: The namespace has no such name.
        RefusedExpression: It would be an attribute of Python's.
    """
    kind = type(value)
    if kind is NameSpace and not hasattr(NameSpace, name) and name not in vars(value):
        try:
            return value[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None
    if kind is YamlDictWrapper and not hasattr(YamlDictWrapper, name):
        return getattr(value, name)
    if kind in PLAIN and not hasattr(kind, name):
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")
    raise RefusedExpression(f"the attribute .{name} of {type_label(value)}")


def add_key(run: Interpreter, key: Any, among: Any) -> Any:
    """Return a key, once its hash and its look-up are paid for."""
    weigh(key, run.budget)
    spend_on_keys([key], len(among), run.budget)
    return key


def items(run: Interpreter, nodes: list[ast.expr], scope: Scope | None) -> Iterator[Any]:
    """Yield the values of the elements of a display or a call; `*x` is all items of x."""
    for node in nodes:
        if type(node) is ast.Starred:
            yield from consumed(run.value(node.value, scope), run.budget)
        else:
            yield run.data(node, scope)


def _constant(_: Interpreter, node: ast.Constant, __: Scope | None) -> Any:
    if type(node.value) is int:
        check_bits(node.value.bit_length())
    return plain(node.value)


def _named(run: Interpreter, node: ast.Name | ast.Attribute, scope: Scope | None) -> Any:
    value = resolve(run, node, scope)
    if type(value) in PLAIN or type(value) in LAZY:
        return value
    if type(value) is Function:
        raise RefusedExpression(f"the function {value.name} as a value")
    raise RefusedExpression(f"{ast.unparse(node)[:40]} as a value")


def _subscript(run: Interpreter, node: ast.Subscript, scope: Scope | None) -> Any:
    value = run.value(node.value, scope)
    if type(node.slice) is ast.Slice:
        part = node.slice
        ends = (
            None if bound is None else run.data(bound, scope)
            for bound in (part.lower, part.upper, part.step)
        )
        if type(value) in PLAIN and hasattr(type(value), "__len__"):
            run.budget.spend_on_copy(len(value))
        return value[slice(*ends)]
    key = run.data(node.slice, scope)
    if type(value) in MAPPINGS:
        add_key(run, key, value)
    return value[key]


def _list(run: Interpreter, node: ast.List, scope: Scope | None) -> list[Any]:
    return list(items(run, node.elts, scope))


def _tuple(run: Interpreter, node: ast.Tuple, scope: Scope | None) -> tuple[Any, ...]:
    return tuple(items(run, node.elts, scope))


def _set(run: Interpreter, node: ast.Set, scope: Scope | None) -> set[Any]:
    result: set[Any] = set()
    for item in items(run, node.elts, scope):
        result.add(add_key(run, item, result))
    return result


def _dict(run: Interpreter, node: ast.Dict, scope: Scope | None) -> dict[Any, Any]:
    result: dict[Any, Any] = {}
    for key, value in zip(node.keys, node.values, strict=True):
        if key is not None:
            at = run.data(key, scope)
            result[add_key(run, at, result)] = run.data(value, scope)
            continue
        more = run.value(value, scope)
        if type(more) not in MAPPINGS:
            raise TypeError(f"{type(more).__name__!r} object is not a mapping")
        spend_on_keys(more, len(result) + len(more), run.budget)
        result |= dict(consumed(more, run.budget))
    return result


def _joined(run: Interpreter, node: ast.JoinedStr, scope: Scope | None) -> str:
    text = "".join(_part(run, part, scope) for part in node.values)
    run.budget.spend_on_text(len(text))
    return text


def _part(run: Interpreter, node: ast.expr, scope: Scope | None) -> str:
    if type(node) is not ast.FormattedValue:
        return str(run.data(node, scope))
    value = run.data(node.value, scope)
    spec = "" if node.format_spec is None else run.data(node.format_spec, scope)
    return formatted(value, _CONVERSIONS[node.conversion], spec, run.budget)


NODES: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {
        ast.Constant: _constant,
        ast.Name: _named,
        ast.Attribute: _named,
        ast.Subscript: _subscript,
        ast.List: _list,
        ast.Tuple: _tuple,
        ast.Set: _set,
        ast.Dict: _dict,
        ast.JoinedStr: _joined,
    }
)
"""The functions by type of node."""
