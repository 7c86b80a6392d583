"""Methods that every object has, and those of nil and symbols."""

from __future__ import annotations

from checker.expand.spawner.formatting import NotWritable, inspect
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.ruby_errors import is_kind
from checker.expand.spawner.values import (
    Constant,
    ErrorValue,
    RubyArray,
    RubyHash,
    RubyString,
    Value,
    class_name,
)

_MORE_NAMES = {
    "Integer": {"Numeric", "Comparable"},
    "Float": {"Numeric", "Comparable"},
    "String": {"Comparable"},
    "Array": {"Enumerable"},
    "Hash": {"Enumerable"},
}


def _to_s(call: Call) -> Value:
    if isinstance(call.receiver.data, RubyString):
        return call.receiver
    return call.run.string(call.run.written(call.receiver, call.span))


def _inspect(call: Call) -> Value:
    try:
        text = inspect(call.receiver.data, call.run.budget)
    except NotWritable as error:
        raise call.refuse(f"which writes out {error}") from None
    return call.run.computed(text, call.span, call.receiver)


def _is_nil(call: Call) -> Value:
    return call.value(call.receiver.data is None)


def _equals(call: Call, other: Value) -> Value:
    return call.value(call.equal(call.receiver, other), other)


def _dup(call: Call) -> Value:
    data = call.receiver.data
    if isinstance(data, RubyString):
        return Value(RubyString(data.content), call.receiver.parameters)
    if isinstance(data, RubyArray):
        return call.run.array(list(data.items), call.receiver)
    if isinstance(data, RubyHash):
        call.run.budget.spend_items(len(data.entries))
        return Value(RubyHash(dict(data.entries), data.default), call.receiver.parameters)
    return call.receiver


def _freeze(call: Call) -> Value:
    data = call.receiver.data
    if isinstance(data, (RubyString, RubyArray, RubyHash)):
        data.frozen = True
    return call.receiver


def _is_frozen(call: Call) -> Value:
    data = call.receiver.data
    if isinstance(data, (RubyString, RubyArray, RubyHash)):
        return call.value(data.frozen)
    return call.value(True)


def _is_a(call: Call, wanted: Value) -> Value:
    if not isinstance(wanted.data, Constant):
        raise call.refuse()
    data, name = call.receiver.data, wanted.data.name
    if isinstance(data, ErrorValue):
        return call.value(is_kind(data.kind, name))
    own = class_name(data)
    return call.value(name == own or name in _MORE_NAMES.get(own, ()) or name == "Object")


def _itself(call: Call) -> Value:
    return call.receiver


COMMON: Methods = {
    "to_s": _to_s,
    "inspect": _inspect,
    "nil?": _is_nil,
    "==": _equals,
    "eql?": lambda call, other: call.value(
        class_name(call.receiver.data) == class_name(other.data)
        and call.equal(call.receiver, other),
        other,
    ),
    "dup": _dup,
    "clone": _dup,
    "freeze": _freeze,
    "frozen?": _is_frozen,
    "is_a?": _is_a,
    "kind_of?": _is_a,
    "itself": _itself,
}

NOTHING: Methods = {
    "to_a": lambda call: call.run.array([], call.receiver),
    "to_i": lambda call: call.value(0),
    "to_f": lambda call: call.value(0.0),
}


SYMBOL: Methods = {
    "to_sym": _itself,
    "name": _to_s,
    "id2name": _to_s,
    "length": lambda call: call.value(len(call.run.written(call.receiver, call.span).text)),
    "size": lambda call: call.value(len(call.run.written(call.receiver, call.span).text)),
}
