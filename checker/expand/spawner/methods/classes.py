"""Methods of classes that make new objects, and of errors."""

from __future__ import annotations

from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.common import COMMON
from checker.expand.spawner.ruby_errors import ERROR_CLASSES
from checker.expand.spawner.values import Constant, ErrorValue, RubyHash, Value


def _new(call: Call, *arguments: Value) -> Value:
    name = call.receiver.data.name if isinstance(call.receiver.data, Constant) else ""
    if name == "Hash" and len(arguments) <= 1:
        return Value(RubyHash(default=arguments[0] if arguments else None))
    if name == "Array" and len(arguments) <= 2:
        return _new_array(call, *arguments)
    if name == "String" and len(arguments) <= 1:
        return call.run.string(call.run.joined(*(call.traced(text) for text in arguments)))
    if name in ERROR_CLASSES and len(arguments) <= 1:
        return Value(ErrorValue(name, call.text(arguments[0]) if arguments else name))
    raise call.refuse()


def _new_array(call: Call, size: Value | None = None, item: Value | None = None) -> Value:
    count = call.integer(size) if size else 0
    if count < 0:
        raise call.refuse("with a negative size")
    call.run.budget.spend_items(count)
    return call.run.array([item or Value(None)] * count)


CLASSES: Methods = {"new": _new, "to_s": COMMON["to_s"], "name": COMMON["to_s"]}

ERROR: Methods = {"message": COMMON["to_s"]}
