"""Evaluation of calls, and of the lambda functions that are passed to them."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from xacro import NameSpace, YamlDictWrapper

from checker.formats.xacro.expression.bounds import RefusedExpression
from checker.formats.xacro.expression.builtins import is_of
from checker.formats.xacro.expression.function import Function, counting
from checker.formats.xacro.expression.interpreter import Handler, Interpreter, Scope
from checker.formats.xacro.expression.methods import METHODS, TAKING_A_KEY, method_of
from checker.formats.xacro.expression.nodes import attribute, items, resolve
from checker.formats.xacro.expression.values import LAZY, MAPPINGS, PLAIN, consumed, plain

Found = tuple[Callable[..., Any], frozenset[int | str]]
"""Function of a call, without budget and arguments, and the arguments that may be functions."""


def _call(run: Interpreter, node: ast.Call, scope: Scope | None) -> Any:
    if type(node.func) is ast.Attribute:
        work, takes = _through_dot(run, node.func, scope)
    else:
        work, takes = _function(resolve(run, node.func, scope))
    if work is is_of and len(node.args) == 2:
        return work(run.budget, run.data(node.args[0], scope), _kinds(run, node.args[1], scope))
    return work(
        run.budget, *_positional(run, node, scope, takes), **_keywords(run, node, scope, takes)
    )


def _through_dot(run: Interpreter, node: ast.Attribute, scope: Scope | None) -> Found:
    """Return what `x.name(…)` calls: a method, or a function of a namespace."""
    base = resolve(run, node.value, scope)
    kind = type(base)
    if kind is NameSpace or (kind is YamlDictWrapper and node.attr not in METHODS[kind]):
        return _function(attribute(base, node.attr))
    if kind not in PLAIN and kind not in LAZY:
        raise RefusedExpression(f"{ast.unparse(node)[:40]}()")
    method = method_of(base, node.attr)
    return (
        lambda budget, *arguments, **named: method(budget, base, *arguments, **named),
        TAKING_A_KEY.get(method, frozenset()),
    )


def _function(value: Any) -> Found:
    if type(value) is Function:
        return value.work, value.takes
    if type(value) in PLAIN or type(value) in LAZY:
        raise TypeError(f"{type(value).__name__!r} object is not callable")
    raise RefusedExpression("a call of a namespace")


def _positional(
    run: Interpreter, node: ast.Call, scope: Scope | None, takes: frozenset[int | str]
) -> list[Any]:
    if takes and any(type(argument) is ast.Starred for argument in node.args[:1]):
        takes = frozenset()
    values: list[Any] = []
    for number, argument in enumerate(node.args):
        if number in takes:
            values.append(_function_or_value(run, argument, scope))
        elif type(argument) is ast.Starred:
            values.extend(items(run, [argument], scope))
        else:
            values.append(run.value(argument, scope))
    return values


def _keywords(
    run: Interpreter, node: ast.Call, scope: Scope | None, takes: frozenset[int | str]
) -> dict[str, Any]:
    named: dict[str, Any] = {}
    for keyword in node.keywords:
        if keyword.arg is None:
            more = run.value(keyword.value, scope)
            if type(more) not in MAPPINGS:
                raise TypeError("argument after ** must be a mapping")
            more = dict(consumed(more, run.budget))
        elif keyword.arg in takes:
            more = {keyword.arg: _function_or_value(run, keyword.value, scope)}
        else:
            more = {keyword.arg: run.value(keyword.value, scope)}
        if named.keys() & more.keys():
            raise TypeError("a keyword argument is given twice")
        if not all(type(name) is str for name in more):
            raise TypeError("keywords must be strings")
        named |= more
    return named


def _function_or_value(run: Interpreter, node: ast.expr, scope: Scope | None) -> Any:
    """Return an argument that may be a function, as functions of Python take it."""
    if type(node) is ast.Lambda:
        return _lambda(run, node, scope)
    if type(node) in (ast.Name, ast.Attribute):
        value = resolve(run, node, scope)
        if type(value) is Function:
            return counting(value, run.budget)
    return run.data(node, scope)


def _lambda(run: Interpreter, node: ast.Lambda, scope: Scope | None) -> Callable[..., Any]:
    """Return what evaluates the body; it ends with the expression."""
    of = node.args
    if of.vararg or of.kwarg or of.kwonlyargs:
        raise RefusedExpression("a lambda function with other than plain parameters")
    parameters = [parameter.arg for parameter in (*of.posonlyargs, *of.args)]
    defaults = [run.data(default, scope) for default in of.defaults]

    def called(*arguments: Any) -> Any:
        missing = len(parameters) - len(arguments)
        if not 0 <= missing <= len(defaults):
            raise TypeError(
                f"<lambda>() takes {len(parameters)} arguments, {len(arguments)} are given"
            )
        inner = Scope(parameters, scope)
        values = (*arguments, *defaults[len(defaults) - missing :])
        inner.values.update(zip(parameters, map(plain, values), strict=True))
        return run.data(node.body, inner)

    return called


def _kinds(run: Interpreter, node: ast.expr, scope: Scope | None) -> tuple[type, ...]:
    """Return the types that the second argument of `isinstance` names."""
    if type(node) is ast.Tuple:
        return tuple(kind for elt in node.elts for kind in _kinds(run, elt, scope))
    if type(node) in (ast.Name, ast.Attribute):
        value = resolve(run, node, scope)
        if type(value) is Function and value.stands_for is not None:
            return (value.stands_for,)
    raise RefusedExpression("isinstance() with other than the types of data")


def _lone_lambda(_: Interpreter, __: ast.Lambda, ___: Scope | None) -> Any:
    raise RefusedExpression(
        "a lambda function that is not an argument of map, filter, sorted, min or max"
    )


CALLS: Mapping[type[ast.AST], Handler] = MappingProxyType(
    {ast.Call: _call, ast.Lambda: _lone_lambda}
)
"""The functions by type of node."""
