"""Binary and unary operators."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from checker.expand.spawner.arithmetic import NotReal, calculate
from checker.expand.spawner.evaluator.interpreter import Handler, Interpreter
from checker.expand.spawner.methods.call import Call
from checker.expand.spawner.methods.table import invoke_method
from checker.expand.spawner.signals import RubyError, Unreadable
from checker.expand.spawner.values import (
    RubyArray,
    RubyHash,
    RubyString,
    Symbol,
    Value,
    class_name,
    equal,
    is_number,
)
from checker.source.ruby import RubyNode

_COMPARISONS: Mapping[str, Callable[[Any, Any], bool]] = MappingProxyType(
    {"<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge}
)
_SHORT = frozenset({"&&", "and", "||", "or"})


def _binary(run: Interpreter, node: RubyNode) -> Value:
    """Evaluate `a + b + c` from the left without nesting, however long the chain is."""
    chain = []
    while node.type == "binary":
        if node.broken:
            raise Unreadable(node.span, "holds Ruby that the parser does not understand")
        chain.append(node)
        node = node.fields["left"]
    value = run.evaluate(node)
    for step in reversed(chain):
        run.budget.spend()
        sign, right = step.fields["operator"].text, step.fields["right"]
        if sign in _SHORT:
            value = _short(run, sign, value, right)
        else:
            value = operate(run, step, sign, value, run.evaluate(right))
    return value


def _short(run: Interpreter, sign: str, left: Value, right: RubyNode) -> Value:
    if left.truthy is (sign in {"||", "or"}):
        return left
    with run.influenced_by(left):
        value = run.evaluate(right)
    return Value(value.data, value.parameters | left.influences)


def operate(run: Interpreter, node: RubyNode, sign: str, left: Value, right: Value) -> Value:
    """Return `left sign right`.

    Raises:
        Unreadable: The operator is not read for these values.
        RubyError: Ruby refuses them.
    """
    if sign in {"==", "!="}:
        return run.value(_equal(run, node, left, right) is (sign == "=="), left, right)
    if isinstance(left.data, (int, float)) and not isinstance(left.data, bool):
        return _numeric(run, node, sign, left.data, left, right)
    if sign in _COMPARISONS and isinstance(left.data, RubyString):
        if not isinstance(right.data, RubyString):
            message = f"comparison of String with {class_name(right.data)} failed"
            raise RubyError("ArgumentError", message, node.span)
        run.budget.spend_text(len(left.data.text))
        return run.value(_COMPARISONS[sign](left.data.text, right.data.text), left, right)
    if isinstance(left.data, (RubyString, RubyArray, RubyHash, Symbol)):
        return invoke_method(Call(run, node, sign, left, [right]))
    raise Unreadable(node.span, f"uses {sign} on {class_name(left.data)}")


def _equal(run: Interpreter, node: RubyNode, left: Value, right: Value) -> bool:
    try:
        return equal(left.data, right.data, run.budget)
    except ValueError as error:
        raise Unreadable(node.span, f"compares arrays {error}") from None


def _numeric(
    run: Interpreter, node: RubyNode, sign: str, a: int | float, left: Value, right: Value
) -> Value:
    b = right.data
    if not is_number(right) or not isinstance(b, (int, float)):
        if sign in _COMPARISONS:
            message = f"comparison of {class_name(a)} with {class_name(b)} failed"
            raise RubyError("ArgumentError", message, node.span)
        name = "nil" if b is None else class_name(b)
        raise RubyError("TypeError", f"{name} can't be coerced into {class_name(a)}", node.span)
    if sign in _COMPARISONS:
        return run.value(_COMPARISONS[sign](a, b), left, right)
    if sign == "<=>":
        return run.value(None if a != a or b != b else (a > b) - (a < b), left, right)  # noqa: PLR0124 NaN
    try:
        result = calculate(sign, a, b)
    except ZeroDivisionError:
        raise RubyError("ZeroDivisionError", "divided by 0", node.span) from None
    except NotReal as error:
        raise Unreadable(node.span, f"computes what is not read: {error}") from None
    if result is None:
        raise Unreadable(node.span, f"uses {sign} on {class_name(a)}")
    return run.value(result, left, right)


def _unary(run: Interpreter, node: RubyNode) -> Value:
    sign, operand = node.fields["operator"].text, node.fields["operand"]
    if sign == "defined?":
        raise Unreadable(node.span, "uses defined?")
    value = run.evaluate(operand)
    if sign in {"!", "not"}:
        return run.value(not value.truthy, value)
    if is_number(value) and isinstance(value.data, (int, float)) and sign in {"-", "+"}:
        return run.value(-value.data if sign == "-" else value.data, value)
    raise Unreadable(node.span, f"uses {sign} on {class_name(value.data)}")


OPERATORS: Mapping[str, Handler] = MappingProxyType({"binary": _binary, "unary": _unary})
