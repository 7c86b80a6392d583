"""Methods of Hash."""

from __future__ import annotations

from collections.abc import Callable, Hashable

from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.signals import RubyError
from checker.expand.spawner.values import (
    NIL,
    RubyArray,
    RubyHash,
    RubyString,
    Value,
    key_of,
)


def _hash(call: Call) -> RubyHash:
    return call.hash(call.receiver)


def _identity(call: Call, key: Value) -> Hashable:
    try:
        return key_of(key, call.run.budget)
    except ValueError as error:
        raise call.refuse(f"with {error} as a key") from None


def _get(call: Call, key: Value) -> Value:
    entry = _hash(call).entries.get(_identity(call, key))
    found = entry[1] if entry else _hash(call).default or NIL
    return Value(found.data, found.parameters | call.receiver.parameters | key.influences)


def _fetch(call: Call, key: Value, default: Value | None = None) -> Value:
    entry = _hash(call).entries.get(_identity(call, key))
    if entry is None and default is None:
        raise RubyError("KeyError", "key not found", call.span)
    found = entry[1] if entry else default or NIL
    return Value(found.data, found.parameters | call.receiver.parameters | key.influences)


def _dig(call: Call, *keys: Value) -> Value:
    value = call.receiver
    for key in keys:
        if value.data is None:
            return value
        inner = Call(call.run, call.node, "dig", value)
        if isinstance(value.data, RubyArray):
            index, items = call.integer(key), value.data.items
            value = items[index] if -len(items) <= index < len(items) else NIL
        else:
            value = _get(inner, key)
    return value


def _merge(call: Call, *others: Value) -> Value:
    result = RubyHash(dict(_hash(call).entries), _hash(call).default)
    call.run.budget.spend_items(len(result.entries))
    _update(call, result, others)
    return Value(result, call.receiver.parameters)


def _merge_in_place(call: Call, *others: Value) -> Value:
    call.changeable()
    _update(call, _hash(call), others)
    return call.receiver


def _update(call: Call, target: RubyHash, others: tuple[Value, ...]) -> None:
    for other in others:
        more = call.hash(other)
        call.run.budget.spend_items(len(more.entries))
        for identity, (key, value) in list(more.entries.items()):
            old = target.entries.get(identity)
            target.entries[identity] = (old[0] if old else key, value)


def _has_key(call: Call, key: Value) -> Value:
    return call.value(_identity(call, key) in _hash(call).entries, key)


def _set(call: Call, key: Value, value: Value) -> Value:
    call.changeable()
    identity = _identity(call, key)
    if isinstance(key.data, RubyString):
        key = Value(RubyString(key.data.content, frozen=True), key.parameters)
    old = _hash(call).entries.get(identity)
    _hash(call).entries[identity] = (old[0] if old else key, value)
    return value


def _delete(call: Call, key: Value) -> Value:
    call.changeable()
    entry = _hash(call).entries.pop(_identity(call, key), None)
    return entry[1] if entry else NIL


def _column(index: int) -> Callable[[Call], Value]:
    def column(call: Call) -> Value:
        entries = _hash(call).entries.values()
        return call.run.array([entry[index] for entry in entries], call.receiver)

    return column


def _each_column(index: int) -> Callable[[Call], Value]:
    def each(call: Call) -> Value:
        call.run.budget.spend_items(len(_hash(call).entries))
        for entry in list(_hash(call).entries.values()):
            call.each(entry[index])
        return call.receiver

    return each


def _kept(wanted: bool) -> Callable[[Call], Value]:
    def keep(call: Call) -> Value:
        call.run.budget.spend_items(len(_hash(call).entries))
        entries = list(_hash(call).entries.items())
        kept = {i: pair for i, pair in entries if call.each(*pair).truthy is wanted}
        return Value(RubyHash(kept), call.receiver.parameters)

    return keep


def _each_pair(call: Call) -> Value:
    call.run.budget.spend_items(len(_hash(call).entries))
    for key, value in list(_hash(call).entries.values()):
        call.each(call.run.array([key, value]))
    return call.receiver


HASH: Methods = {
    "[]": _get,
    "[]=": _set,
    "store": _set,
    "fetch": _fetch,
    "dig": _dig,
    "merge": _merge,
    "merge!": _merge_in_place,
    "update": _merge_in_place,
    "key?": _has_key,
    "has_key?": _has_key,
    "include?": _has_key,
    "member?": _has_key,
    "delete": _delete,
    "keys": _column(0),
    "values": _column(1),
    "length": lambda call: call.value(len(_hash(call).entries)),
    "size": lambda call: call.value(len(_hash(call).entries)),
    "empty?": lambda call: call.value(not _hash(call).entries),
    "to_h": lambda call: call.receiver,
}

HASH_WITH_BLOCK: Methods = {
    "each_pair": _each_pair,
    "each_key": _each_column(0),
    "each_value": _each_column(1),
    "select": _kept(True),
    "filter": _kept(True),
    "reject": _kept(False),
}
