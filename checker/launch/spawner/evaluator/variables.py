"""Variables: reading them, setting them, and what an untaken branch would have set."""

from __future__ import annotations

import math
from collections.abc import Mapping

from checker.launch.spawner.evaluator.expressions import elements, store
from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.evaluator.operators import operate
from checker.launch.spawner.methods.call import Call
from checker.launch.spawner.methods.classes import invoke_method
from checker.launch.spawner.signals import ERROR_CLASSES, RubyError, Unreadable
from checker.launch.spawner.values import Constant, RubyArray, RubyHash, Value, truthy
from checker.source.ruby import RubyNode

_CLASSES = ERROR_CLASSES | {
    *("Array", "File", "Float", "Hash", "Integer", "Math", "Numeric", "String", "Symbol", "YAML")
}
_NUMBERS = {"Math::PI": math.pi, "Float::INFINITY": math.inf}


def define_untaken(run: Interpreter, branch: RubyNode) -> None:
    """Set the variables that only an untaken branch sets to nil."""
    nodes = branch.walk()
    run.budget.spend_items(len(nodes))
    inner_end = 0
    for node in nodes:
        if node.type in _INNER_SCOPES:
            inner_end = max(inner_end, node.end)
        target = node.fields.get("left") if node.type in _ASSIGNMENTS else None
        if target is None or target.type != "identifier" or node.start < inner_end:
            continue
        if run.scope.holder(target.text) is None:
            run.scope.assign(target.text, None)


_ASSIGNMENTS = frozenset({"assignment", "operator_assignment"})
_INNER_SCOPES = frozenset({"block", "do_block", "method"})


def _global(run: Interpreter, node: RubyNode) -> Value:
    if node.text == "$0":
        return run.computed("/usr/bin/ruby", node.span)
    return run.globals.get(node.text)


def _constant(run: Interpreter, node: RubyNode) -> Value:
    if node.text in run.constants:
        return run.constants[node.text]
    if node.text in _CLASSES:
        return Constant(node.text)
    if node.text in _NUMBERS:
        return _NUMBERS[node.text]
    raise Unreadable(node.span, f"uses {node.text[:60]}, which is not supported")


def assign(run: Interpreter, target: RubyNode, value: Value) -> None:
    """Set a variable, an element, or several at once.

    Raises:
        Unreadable: The target is of another kind, such as an attribute of an object.
    """
    if target.type == "identifier":
        run.scope.assign(target.text, value)
    elif target.type == "global_variable":
        run.globals[target.text] = value
    elif target.type == "constant":
        run.constants[target.text] = value
    elif target.type == "element_reference":
        _set_element(run, target, value)
    elif target.type == "left_assignment_list":
        items = value.items if isinstance(value, RubyArray) else [value]
        for index, part in enumerate(target.parts):
            assign(run, part, items[index] if index < len(items) else None)
    else:
        raise Unreadable(target.span, f"assigns to '{target.text[:60]}', which is not supported")


def _set_element(run: Interpreter, target: RubyNode, value: Value) -> None:
    holder = run.evaluate(target.fields["object"])
    keys = elements(run, target.parts[1:])
    if len(keys) != 1 or not isinstance(holder, (RubyHash, RubyArray)):
        raise Unreadable(target.span, "assigns to an element, which is not supported here")
    if holder.frozen:
        raise RubyError("FrozenError", "can't modify frozen Array or Hash", target.span)
    if isinstance(holder, RubyHash):
        store(run, holder, keys[0], value, target)
        return
    index = keys[0]
    if type(index) is not int or not -len(holder.items) <= index <= len(holder.items):
        raise Unreadable(target.span, "sets an element beyond the end of an array")
    holder.items[index : index + 1 or None] = [value]


def _assignment(run: Interpreter, node: RubyNode) -> Value:
    right = node.fields["right"]
    if right.type == "right_assignment_list":
        value = run.array(elements(run, right.parts))
    else:
        value = run.evaluate(right)
    assign(run, node.fields["left"], value)
    return value


def _operator_assignment(run: Interpreter, node: RubyNode) -> Value:
    target, sign = node.fields["left"], node.fields["operator"].text[:-1]
    old = _old_value(run, target)
    if sign in {"||", "&&"}:
        if truthy(old) is (sign == "||"):
            return old
        value = run.evaluate(node.fields["right"])
    else:
        value = operate(run, node, sign, old, run.evaluate(node.fields["right"]))
    assign(run, target, value)
    return value


def _old_value(run: Interpreter, target: RubyNode) -> Value:
    """Read; a variable that is not set yet is nil."""
    if target.type == "identifier":
        holder = run.scope.holder(target.text)
        return holder.variables[target.text] if holder else None
    if target.type == "global_variable":
        return run.globals.get(target.text)
    if target.type == "constant":
        return run.constants.get(target.text)
    if target.type == "element_reference":
        return run.evaluate(target)
    raise Unreadable(target.span, f"assigns to '{target.text[:60]}', which is not supported")


def _element(run: Interpreter, node: RubyNode) -> Value:
    holder = run.evaluate(node.fields["object"])
    keys = elements(run, node.parts[1:])
    return invoke_method(Call(run, node, "[]", holder, keys))


VARIABLES: Mapping[str, Handler] = {
    "global_variable": _global,
    "constant": _constant,
    "scope_resolution": _constant,
    "assignment": _assignment,
    "operator_assignment": _operator_assignment,
    "element_reference": _element,
}
