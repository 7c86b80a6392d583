"""Operators: Python's own, on data alone, once the size of the result is known."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from types import MappingProxyType, NoneType
from typing import Any

from checker.formats.xacro.expression.bounds import Budget, RefusedExpression, check_bits
from checker.formats.xacro.expression.format import percent
from checker.formats.xacro.expression.values import (
    LAZY,
    MAPPINGS,
    NUMBERS,
    PLAIN,
    SIZED,
    plain,
    spend_on_keys,
    type_label,
    weigh,
)

Binary = Callable[[Any, Any], Any]

BINARY: Mapping[type[ast.operator], Binary] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.FloorDiv: operator.floordiv,
        ast.Mod: operator.mod,
        ast.Pow: operator.pow,
        ast.LShift: operator.lshift,
        ast.RShift: operator.rshift,
        ast.BitAnd: operator.and_,
        ast.BitOr: operator.or_,
        ast.BitXor: operator.xor,
    }
)
UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = MappingProxyType(
    {
        ast.UAdd: operator.pos,
        ast.USub: operator.neg,
        ast.Invert: operator.invert,
        ast.Not: operator.not_,
    }
)
COMPARISONS: Mapping[type[ast.cmpop], Binary] = MappingProxyType(
    {
        ast.Eq: operator.eq,
        ast.NotEq: operator.ne,
        ast.Lt: operator.lt,
        ast.LtE: operator.le,
        ast.Gt: operator.gt,
        ast.GtE: operator.ge,
        ast.Is: operator.is_,
        ast.IsNot: operator.is_not,
        ast.In: lambda left, right: left in right,
        ast.NotIn: lambda left, right: left not in right,
    }
)
_GROWING: Mapping[type[ast.operator], Callable[[int, int], int]] = MappingProxyType(
    {
        ast.Mult: lambda left, right: left.bit_length() + right.bit_length(),
        ast.Pow: lambda left, right: left.bit_length() * right if abs(left) > 1 else 0,
        ast.LShift: lambda left, right: left.bit_length() + right if left else 0,
    }
)
"""Greatest number of bits of the result."""
_INTEGERS = frozenset({int, bool})


def apply_binary(kind: type[ast.operator], left: Any, right: Any, budget: Budget) -> Any:
    """Return what an operator makes of two values.

    Raises:
        RefusedExpression: The operator, or a result of that type, is not in the language.
        ExpressionLimit: The result would be too large.
        Exception: What Python raises for such values.
    """
    operation = BINARY.get(kind)
    if operation is None:
        raise RefusedExpression("the operator @")
    types = {type(left), type(right)}
    if types <= NUMBERS:
        if types <= _INTEGERS and (bits := _GROWING.get(kind)):
            check_bits(bits(left, right))
    elif kind is ast.Mod and type(left) is str:
        return percent(left, right, budget)
    elif kind is ast.Mult:
        _spend_on_repetition(left, right, budget)
    else:
        _spend_on_both(kind, left, right, budget)
    result = operation(left, right)
    if type(result) not in PLAIN:
        raise RefusedExpression(type_label(result))
    if type(result) is int:
        _spend_on_number(result, budget)
    return result


def multiply(left: Any, right: Any, budget: Budget) -> Any:
    """Return a product, bounded as that of the operator."""
    return apply_binary(ast.Mult, left, right, budget)


def apply_unary(kind: type[ast.unaryop], value: Any) -> Any:
    """Return what an operator makes of one value."""
    return UNARY[kind](value)


def apply_comparison(kind: type[ast.cmpop], left: Any, right: Any, budget: Budget) -> Any:
    """Return what comparing two values yields.

    Raises:
        RefusedExpression: A value is no data, or its identity would show.
    """
    if kind in (ast.Is, ast.IsNot):
        if not {type(left), type(right)} & {NoneType, bool}:
            raise RefusedExpression("'is' between values other than None, True and False")
    elif not {type(left), type(right)} <= NUMBERS:
        if kind in (ast.In, ast.NotIn):
            spend_on_search(left, right, budget)
        else:
            weigh(left, budget)
            weigh(right, budget)
    return COMPARISONS[kind](left, right)


def spend_on_search(sought: Any, among: Any, budget: Budget) -> None:
    """Take the steps of finding one value among others."""
    if type(among) in LAZY:
        raise RefusedExpression(f"'in' with {type_label(among)}")
    weigh(plain(sought), budget)
    if type(among) is str and type(sought) is str:
        budget.spend_on_search(len(among), len(sought))
    elif type(among) is range:
        budget.spend(1 if type(sought) in _INTEGERS else 1 + len(among))
    elif type(among) in MAPPINGS or type(among) in (set, frozenset):
        spend_on_keys([sought], len(among), budget)
    else:
        weigh(among, budget)


def _spend_on_number(number: int, budget: Budget) -> None:
    bits = number.bit_length()
    if bits > 64:
        check_bits(bits)
        budget.spend(bits // 256)


def _spend_on_repetition(left: Any, right: Any, budget: Budget) -> None:
    for items, times in ((left, right), (right, left)):
        if type(items) in SIZED and type(times) in _INTEGERS:
            length = len(items) * max(times, 0)
            if type(items) is str:
                budget.spend_on_text(length)
            else:
                budget.spend_on_copy(length)


def _spend_on_both(kind: type[ast.operator], left: Any, right: Any, budget: Budget) -> None:
    length = sum(len(operand) for operand in (left, right) if type(operand) in SIZED)
    if type(left) is str:
        budget.spend_on_text(length)
    elif kind is ast.Add:
        budget.spend_on_copy(length)
    elif length:
        for operand in (left, right):
            weigh(operand, budget)
            if type(operand) in SIZED:
                spend_on_keys(operand, length, budget)
