"""Binary and unary operators."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.methods.call import Call
from checker.launch.spawner.methods.classes import invoke_method
from checker.launch.spawner.methods.number import NotReal, calculate
from checker.launch.spawner.signals import RubyError, Unreadable
from checker.launch.spawner.values import (
    RubyArray,
    RubyString,
    Value,
    class_name,
    is_number,
    truthy,
)
from checker.source.ruby import RubyNode

_COMPARISONS: Mapping[str, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}
_SHORT = frozenset({"&&", "and", "||", "or"})


def _binary(run: Interpreter, node: RubyNode) -> Value:
    """Evaluate `a + b + c` from the left without nesting, however long the chain is."""
    chain = []
    while node.type == "binary":
        if node.broken:
            raise Unreadable(node.span, "contains Ruby that the parser does not understand")
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
    if truthy(left) is (sign in {"||", "or"}):
        return left
    return run.evaluate(right)


def operate(run: Interpreter, node: RubyNode, sign: str, left: Value, right: Value) -> Value:
    """Return `left sign right`.

    Raises:
        Unreadable: The operator is not read for these values.
        RubyError: Ruby refuses them.
    """
    if sign in {"==", "!="}:
        return run.equal(left, right, node.span) is (sign == "==")
    if is_number(left):
        return _numeric(node, sign, left, right)
    if isinstance(left, (RubyString, RubyArray)):
        return invoke_method(Call(run, node, sign, left, [right]))
    raise Unreadable(node.span, f"uses {sign} on {class_name(left)}")


def _numeric(node: RubyNode, sign: str, a: int | float, b: Value) -> Value:
    if not is_number(b):
        if sign in _COMPARISONS:
            message = f"comparison of {class_name(a)} with {class_name(b)} failed"
            raise RubyError("ArgumentError", message, node.span)
        name = "nil" if b is None else class_name(b)
        raise RubyError("TypeError", f"{name} can't be coerced into {class_name(a)}", node.span)
    if sign in _COMPARISONS:
        return _COMPARISONS[sign](a, b)
    try:
        result = calculate(sign, a, b)
    except ZeroDivisionError:
        raise RubyError("ZeroDivisionError", "divided by 0", node.span) from None
    except NotReal as error:
        raise Unreadable(node.span, f"computes something that is not supported: {error}") from None
    if result is None:
        raise Unreadable(node.span, f"uses {sign} on {class_name(a)}")
    return result


def _unary(run: Interpreter, node: RubyNode) -> Value:
    sign, operand = node.fields["operator"].text, node.fields["operand"]
    if sign == "defined?":
        return _defined(run, node, operand)
    value = run.evaluate(operand)
    if sign in {"!", "not"}:
        return not truthy(value)
    if is_number(value) and sign in {"-", "+"}:
        return -value if sign == "-" else value
    raise Unreadable(node.span, f"uses {sign} on {class_name(value)}")


def _defined(run: Interpreter, node: RubyNode, operand: RubyNode) -> Value:
    """Return what `defined?` states about a variable or function; nil when there is none."""
    if operand.type == "parenthesized_statements" and len(operand.parts) == 1:
        operand = operand.parts[0]
    name = operand.text
    if operand.type == "global_variable":
        found = "global-variable" if name in run.globals else None
    elif operand.type == "identifier":
        function = "method" if name in run.functions else None
        found = "local-variable" if run.scope.holder(name) else function
    else:
        raise Unreadable(node.span, "uses defined? on more than a name")
    return None if found is None else run.computed(found, node.span)


OPERATORS: Mapping[str, Handler] = {"binary": _binary, "unary": _unary}
