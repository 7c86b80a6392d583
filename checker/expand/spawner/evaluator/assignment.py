"""Variables: reading them, setting them, and what an untaken branch would have set."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from checker.expand.spawner.evaluator.expressions import elements, store
from checker.expand.spawner.evaluator.interpreter import Handler, Interpreter
from checker.expand.spawner.evaluator.operators import operate
from checker.expand.spawner.files import absolute, folder_of
from checker.expand.spawner.limits import ITEMS_PER_STEP
from checker.expand.spawner.methods.call import Call
from checker.expand.spawner.methods.table import invoke_method
from checker.expand.spawner.ruby_errors import ERROR_CLASSES
from checker.expand.spawner.signals import RubyError, Unreadable
from checker.expand.spawner.values import NIL, Constant, RubyArray, RubyHash, Value
from checker.source.ruby import RubyNode

_MODULES = frozenset(
    {"File", "YAML", "Psych", "Math", "Hash", "Array", "String", "Float", "Integer", "Numeric"}
    | {"Symbol", "Range", "NilClass", "TrueClass", "FalseClass"}
)
_PLAIN_TARGETS = frozenset({"identifier", "global_variable", "constant"})


def variable(run: Interpreter, node: RubyNode) -> Value | None:
    """Return a local variable; nil when its assignment stands above but was not reached."""
    name = node.text
    value = run.scope.find(name)
    if value is None:
        if not _assigned_above(run, node, name):
            return None
        value = Value(None)
    return _read(run, value)


def _read(run: Interpreter, value: Value) -> Value:
    if run.influences <= value.parameters:
        return value
    return Value(value.data, value.parameters | run.influences)


def _assigned_above(run: Interpreter, node: RubyNode, name: str) -> bool:
    scope = run.scope
    while True:
        end = _assigned(run, scope.body).get(name)
        if end is not None and end <= node.start and scope.body.source is node.source:
            return True
        if scope.parent is None:
            return False
        scope = scope.parent


def _assigned(run: Interpreter, body: RubyNode) -> Mapping[str, int]:
    """Return the variables that plain assignments (`=`) below a node set, looked for once."""
    found = run.assigned.get(body)
    if found is None:
        found = run.assigned[body] = {}
        for target in _targets(run, body):
            found[target.text] = min(target.end, found.get(target.text, target.end))
    return found


def _targets(run: Interpreter, body: RubyNode) -> Iterator[RubyNode]:
    waiting = [body]
    while waiting:
        node = waiting.pop()
        run.budget.spend(len(node.children) // ITEMS_PER_STEP)
        if node.type == "method" and node is not body:
            continue
        if node.type in {"assignment", "operator_assignment", "for"}:
            target = node.fields.get("left") or node.fields.get("pattern")
            if target is not None:
                yield from target.parts if target.type == "left_assignment_list" else [target]
        waiting.extend(node.children)


def mark_untaken(run: Interpreter, branch: RubyNode, influences: frozenset[str]) -> None:
    """Note that what a branch sets was left alone because of `influences`.

    A branch that would have returned makes all that follows depend on them.
    """
    if not influences:
        return
    nodes = branch.walk()
    run.budget.spend_items(len(nodes))
    if any(node.type == "return" for node in nodes):
        run.influences |= influences
    for target in (node.fields.get("left") for node in nodes if node.type == "assignment"):
        value = run.scope.find(target.text) if target and target.type == "identifier" else None
        if target and value is not None:
            run.scope.assign(target.text, Value(value.data, value.parameters | influences))


def _global(run: Interpreter, node: RubyNode) -> Value:
    if node.text in {"$0", "$PROGRAM_NAME"}:
        return run.computed("/usr/bin/ruby", node.span)
    return _read(run, run.globals.get(node.text) or Value(None))


def _constant(run: Interpreter, node: RubyNode) -> Value:
    name = node.text
    if name in run.constants:
        return _read(run, run.constants[name])
    if name in _MODULES or name in ERROR_CLASSES:
        return Value(Constant(name))
    raise Unreadable(node.span, f"uses {name}, which is not read")


def _scoped_constant(run: Interpreter, node: RubyNode) -> Value:
    import math

    numbers = {
        "Math::PI": math.pi,
        "Math::E": math.e,
        "Float::INFINITY": math.inf,
        "Float::NAN": math.nan,
    }
    if node.text in numbers:
        return run.value(numbers[node.text])
    if node.text in ERROR_CLASSES:
        return Value(Constant(node.text))
    raise Unreadable(node.span, f"uses {node.text[:60]}, which is not read")


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
    elif target.type in {"left_assignment_list", "destructured_left_assignment"}:
        _assign_many(run, target, value)
    else:
        raise Unreadable(target.span, f"assigns to '{target.text[:60]}', which is not read")


def _assign_many(run: Interpreter, target: RubyNode, value: Value) -> None:
    items = value.data.items if isinstance(value.data, RubyArray) else [value]
    run.budget.spend_items(len(items))
    for index, part in enumerate(target.parts):
        if part.type in {"rest_assignment", "splat_argument"}:
            behind = len(target.parts) - index - 1
            rest = items[index : max(index, len(items) - behind)]
            for name in part.parts:
                assign(run, name, run.array(list(rest), value))
            items = [*items[:index], Value(None), *items[index + len(rest) :]]
            continue
        item = items[index] if index < len(items) else Value(None)
        assign(run, part, Value(item.data, item.parameters | value.parameters))


def _set_element(run: Interpreter, target: RubyNode, value: Value) -> None:
    holder = run.evaluate(target.fields["object"])
    keys = elements(run, target.parts[1:])
    data = holder.data
    if len(keys) != 1 or not isinstance(data, (RubyHash, RubyArray)):
        raise Unreadable(target.span, "assigns to an element, which is not read here")
    if data.frozen:
        raise RubyError("FrozenError", "can't modify frozen Array or Hash", target.span)
    if isinstance(data, RubyHash):
        store(run, data, keys[0], value, target)
        return
    index = keys[0].data
    if type(index) is not int or not -len(data.items) <= index <= len(data.items) + 1000:
        raise Unreadable(target.span, "sets an element far behind the end of an array")
    missing = max(0, index + 1 - len(data.items))
    run.budget.spend_items(missing)
    data.items += [NIL] * missing
    data.items[index] = value


def _assignment(run: Interpreter, node: RubyNode) -> Value:
    right = node.fields["right"]
    if right.type == "right_assignment_list":
        value = run.array(elements(run, right.parts))
    elif right.type == "splat_argument":
        value = run.array(elements(run, [right]))
    else:
        value = run.evaluate(right)
    assign(run, node.fields["left"], value)
    return value


def _operator_assignment(run: Interpreter, node: RubyNode) -> Value:
    target, sign = node.fields["left"], node.fields["operator"].text[:-1]
    if target.type not in _PLAIN_TARGETS | {"element_reference"}:
        raise Unreadable(target.span, f"assigns to '{target.text[:60]}', which is not read")
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
        return run.scope.find(target.text) or Value(None)
    if target.type == "global_variable":
        return run.globals.get(target.text) or Value(None)
    if target.type == "constant":
        return run.constants.get(target.text) or Value(None)
    return run.evaluate(target)


def _element(run: Interpreter, node: RubyNode) -> Value:
    holder = run.evaluate(node.fields["object"])
    keys = elements(run, node.parts[1:])
    return invoke_method(Call(run, node, "[]", holder, keys))


def _self(_run: Interpreter, node: RubyNode) -> Value:
    raise Unreadable(node.span, "uses self, which is not read")


def special_identifier(run: Interpreter, node: RubyNode) -> Value | None:
    """Return `__FILE__`, `__dir__` and `__LINE__`."""
    if node.text == "__FILE__":
        return run.computed(absolute(run.scope.path), node.span)
    if node.text == "__dir__":
        return run.computed(folder_of(absolute(run.scope.path)), node.span)
    if node.text == "__LINE__":
        return run.value(node.source.position(node.start)[0])
    return None


VARIABLES: Mapping[str, Handler] = MappingProxyType(
    {
        "global_variable": _global,
        "constant": _constant,
        "scope_resolution": _scoped_constant,
        "assignment": _assignment,
        "operator_assignment": _operator_assignment,
        "element_reference": _element,
        "self": _self,
    }
)
