"""Variables: reading them, setting them, and what an untaken branch would have set."""

from __future__ import annotations

import math
from collections.abc import Mapping

from checker.launch.spawner.evaluator.expressions import elements, store
from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.evaluator.operators import operate
from checker.launch.spawner.files import absolute, folder_of
from checker.launch.spawner.methods.call import Call
from checker.launch.spawner.methods.classes import invoke_method
from checker.launch.spawner.signals import ERROR_CLASSES, RubyError, Unreadable
from checker.launch.spawner.values import NIL, Constant, RubyArray, RubyHash, Value
from checker.source.ruby import RubyNode

_CLASSES = ERROR_CLASSES | {
    *("Array", "File", "Float", "Hash", "Integer", "Math", "Numeric", "String", "Symbol", "YAML")
}
_NUMBERS = {"Math::PI": math.pi, "Float::INFINITY": math.inf}


def variable(run: Interpreter, node: RubyNode) -> Value | None:
    """Return a local variable, `__FILE__` or `__dir__`; None if there is none of this name."""
    value = run.scope.find(node.text)
    if value is not None:
        return _read(run, value)
    if node.text == "__FILE__":
        return run.computed(absolute(run.scope.path), node.span)
    if node.text == "__dir__":
        return run.computed(folder_of(absolute(run.scope.path)), node.span)
    return None


def _read(run: Interpreter, value: Value) -> Value:
    if run.influences <= value.parameters:
        return value
    return Value(value.data, value.parameters | run.influences)


def mark_untaken(run: Interpreter, branch: RubyNode, influences: frozenset[str]) -> None:
    """Note that what a branch sets was left alone because of `influences`.

    A variable that only the branch sets is nil. A branch that would have returned makes all that
    follows depend on them.
    """
    nodes = branch.walk()
    run.budget.spend_items(len(nodes))
    inner_end = 0
    for node in nodes:
        if node.type == "return":
            run.influences |= influences
        if node.type in _INNER_SCOPES:
            inner_end = max(inner_end, node.end)
        target = node.fields.get("left") if node.type in _ASSIGNMENTS else None
        if target is None or target.type != "identifier":
            continue
        value = run.scope.find(target.text)
        if value is not None or node.start >= inner_end:
            value = value or NIL
            run.scope.assign(target.text, Value(value.data, value.parameters | influences))


_ASSIGNMENTS = frozenset({"assignment", "operator_assignment"})
_INNER_SCOPES = frozenset({"block", "do_block", "method"})


def _global(run: Interpreter, node: RubyNode) -> Value:
    if node.text == "$0":
        return run.computed("/usr/bin/ruby", node.span)
    return _read(run, run.globals.get(node.text, NIL))


def _constant(run: Interpreter, node: RubyNode) -> Value:
    if node.text in run.constants:
        return _read(run, run.constants[node.text])
    if node.text in _CLASSES:
        return Value(Constant(node.text))
    if node.text in _NUMBERS:
        return run.value(_NUMBERS[node.text])
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
        items = value.data.items if isinstance(value.data, RubyArray) else [value]
        for index, part in enumerate(target.parts):
            item = items[index] if index < len(items) else NIL
            assign(run, part, Value(item.data, item.parameters | value.parameters))
    else:
        raise Unreadable(target.span, f"assigns to '{target.text[:60]}', which is not supported")


def _set_element(run: Interpreter, target: RubyNode, value: Value) -> None:
    holder = run.evaluate(target.fields["object"])
    keys = elements(run, target.parts[1:])
    data = holder.data
    if len(keys) != 1 or not isinstance(data, (RubyHash, RubyArray)):
        raise Unreadable(target.span, "assigns to an element, which is not supported here")
    if data.frozen:
        raise RubyError("FrozenError", "can't modify frozen Array or Hash", target.span)
    if isinstance(data, RubyHash):
        store(run, data, keys[0], value, target)
        return
    index = keys[0].data
    if type(index) is not int or not -len(data.items) <= index <= len(data.items):
        raise Unreadable(target.span, "sets an element beyond the end of an array")
    data.items[index : index + 1 or None] = [value]


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
        if old.truthy is (sign == "||"):
            return old
        with run.influenced_by(old):
            value = run.evaluate(node.fields["right"])
    else:
        value = operate(run, node, sign, old, run.evaluate(node.fields["right"]))
    assign(run, target, value)
    return value


def _old_value(run: Interpreter, target: RubyNode) -> Value:
    """Read without noting why this code runs: `sdf += …` does not change what sdf held."""
    if target.type == "identifier":
        return run.scope.find(target.text) or NIL
    if target.type == "global_variable":
        return run.globals.get(target.text, NIL)
    if target.type == "constant":
        return run.constants.get(target.text, NIL)
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
