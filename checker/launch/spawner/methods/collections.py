"""Methods of Array and Hash."""

from __future__ import annotations

from collections.abc import Hashable

from checker.launch.spawner.literals import TracedString, join_strings
from checker.launch.spawner.methods.call import Call, Method, Methods
from checker.launch.spawner.methods.enumerable import ENUMERABLE_WITH_BLOCK, last
from checker.launch.spawner.signals import RubyError
from checker.launch.spawner.values import RubyArray, RubyHash, RubyRange, Value, key_of, truthy

_MAX_NESTING = 12


def _items(call: Call) -> list[Value]:
    return call.array(call.receiver).items


def _at(call: Call, index: Value) -> Value:
    items = _items(call)
    if isinstance(index, RubyRange):
        bounds = index.bounds_in(len(items))
        return call.run.array(items[slice(*bounds)]) if bounds else None
    if isinstance(index, float):
        index = call.truncate(index)
    if type(index) is not int:
        raise call.refuse("with something else than an integer")
    return items[index] if -len(items) <= index < len(items) else None


def _push(call: Call, *values: Value) -> Value:
    call.changeable()
    _items(call).extend(values)
    return call.receiver


def _concat(call: Call, *others: Value) -> Value:
    call.changeable()
    for other in others:
        call.run.budget.spend_items(len(call.array(other).items))
        _items(call).extend(list(call.array(other).items))
    return call.receiver


def _removed(index: int) -> Method:
    def removed(call: Call) -> Value:
        call.changeable()
        call.run.budget.spend_items(len(_items(call)))
        return _items(call).pop(index) if _items(call) else None

    return removed


def _times(call: Call, factor: Value) -> Value:
    count = call.integer(factor)
    if count < 0:
        raise call.refuse("with a negative number")
    call.run.budget.spend_items(len(_items(call)) * count)
    return call.run.array(_items(call) * (count if _items(call) else 0))


def _flat(call: Call, items: list[Value], depth: int = 0) -> list[Value]:
    if depth > _MAX_NESTING:
        raise call.refuse("with arrays nested too deeply")
    result: list[Value] = []
    for item in items:
        call.run.budget.spend()
        result += _flat(call, item.items, depth + 1) if isinstance(item, RubyArray) else [item]
    return result


def _join(call: Call, separator: Value = None) -> Value:
    between = call.traced(separator) if separator is not None else TracedString()
    parts: list[TracedString] = []
    for item in _flat(call, _items(call)):
        text = call.run.written(item, call.span)
        call.run.budget.spend_items(len(between.pieces))
        parts += [between, text] if parts else [text]
    return call.run.string(join_strings(parts))


ARRAY: Methods = {
    "[]": _at,
    "<<": _push,
    "+": lambda call, other: call.run.array(_items(call) + call.array(other).items),
    "*": _times,
    "any?": lambda call: any(truthy(item) for item in _items(call)),
    "compact": lambda call: call.run.array([item for item in _items(call) if item is not None]),
    "concat": _concat,
    "empty?": lambda call: not _items(call),
    "flatten": lambda call: call.run.array(_flat(call, _items(call))),
    "join": _join,
    "last": last,
    "length": lambda call: len(_items(call)),
    "pop": _removed(-1),
    "push": _push,
    "reverse": lambda call: call.run.array(_items(call)[::-1]),
    "shift": _removed(0),
    "size": lambda call: len(_items(call)),
}


def _entries(call: Call) -> dict[Hashable, tuple[Value, Value]]:
    return call.hash(call.receiver).entries


def _identity(call: Call, key: Value) -> Hashable:
    try:
        return key_of(key, call.run.budget)
    except ValueError as error:
        raise call.refuse(f"with {error} as a key") from None


def _get(call: Call, key: Value) -> Value:
    return _fetch_or(call, key, call.hash(call.receiver).default)


def _fetch_or(call: Call, key: Value, default: Value) -> Value:
    entry = _entries(call).get(_identity(call, key))
    return entry[1] if entry else default


def _fetch(call: Call, key: Value, default: Value = None) -> Value:
    if len(call.arguments) == 1 and _identity(call, key) not in _entries(call):
        raise RubyError("KeyError", "key not found", call.span)
    return _fetch_or(call, key, default)


def _dig(call: Call, *keys: Value) -> Value:
    value = call.receiver
    for key in keys:
        if value is None:
            return value
        holder = Call(call.run, call.node, "dig", value)
        value = _at(holder, key) if isinstance(value, RubyArray) else _get(holder, key)
    return value


def _merge(call: Call, *others: Value) -> Value:
    own = call.hash(call.receiver)
    call.run.budget.spend_items(len(own.entries))
    result = RubyHash(dict(own.entries), own.default)
    _update(call, result, others)
    return result


def _merge_in_place(call: Call, *others: Value) -> Value:
    call.changeable()
    _update(call, call.hash(call.receiver), others)
    return call.receiver


def _update(call: Call, target: RubyHash, others: tuple[Value, ...]) -> None:
    for other in others:
        more = call.hash(other)
        call.run.budget.spend_items(len(more.entries))
        for identity, (key, value) in list(more.entries.items()):
            old = target.entries.get(identity)
            target.entries[identity] = (old[0] if old else key, value)


def _column(index: int) -> Method:
    def column(call: Call) -> Value:
        return call.run.array([entry[index] for entry in _entries(call).values()])

    return column


def _has_key(call: Call, key: Value) -> Value:
    return _identity(call, key) in _entries(call)


HASH: Methods = {
    "[]": _get,
    "dig": _dig,
    "empty?": lambda call: not _entries(call),
    "fetch": _fetch,
    "has_key?": _has_key,
    "include?": _has_key,
    "key?": _has_key,
    "keys": _column(0),
    "length": lambda call: len(_entries(call)),
    "merge": _merge,
    "merge!": _merge_in_place,
    "size": lambda call: len(_entries(call)),
    "values": _column(1),
}

HASH_WITH_BLOCK: Methods = {
    **ENUMERABLE_WITH_BLOCK,
    "each_pair": ENUMERABLE_WITH_BLOCK["each"],
}
