"""Methods of Array."""

from __future__ import annotations

from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.iteration import listed
from checker.expand.spawner.signals import Unreadable
from checker.expand.spawner.traced import TracedString, joined
from checker.expand.spawner.values import NIL, RubyArray, RubyRange, RubyString, Value

_MAX_NESTING = 12


def _items(call: Call) -> list[Value]:
    return call.array(call.receiver).items


def _at(call: Call, index: Value, count: Value | None = None) -> Value:
    items = _items(call)
    if count is not None or isinstance(index.data, RubyRange):
        return _part(call, index, count)
    number = index.data
    if isinstance(number, float):
        number = call.whole(number)
    if type(number) is not int:
        raise call.refuse("with something else than an integer")
    found = items[number] if -len(items) <= number < len(items) else NIL
    extra = call.receiver.parameters | index.parameters
    return Value(found.data, found.parameters | extra)


def _part(call: Call, index: Value, count: Value | None) -> Value:
    bounds = slice_bounds(call, len(_items(call)), index, count)
    if bounds is None:
        return NIL
    return call.run.array(_items(call)[bounds[0] : bounds[1]], call.receiver, index)


def slice_bounds(
    call: Call, length: int, index: Value, count: Value | None
) -> tuple[int, int] | None:
    """Return start and end of `[start, count]` or `[range]`, or None where Ruby gives nil."""
    if isinstance(index.data, RubyRange) and count is None:
        bounds = index.data
        start = bounds.first + length if bounds.first < 0 else bounds.first
        last = bounds.last + length if bounds.last < 0 else bounds.last
        end = last if bounds.exclusive else last + 1
    elif count is not None:
        start = call.integer(index)
        start += length if start < 0 else 0
        if call.integer(count) < 0:
            return None
        end = start + call.integer(count)
    else:
        raise call.refuse()
    if not 0 <= start <= length:
        return None
    return start, max(start, min(end, length))


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


def _pop(call: Call) -> Value:
    call.changeable()
    return _items(call).pop() if _items(call) else NIL


def _shift(call: Call) -> Value:
    call.changeable()
    call.run.budget.spend_items(len(_items(call)))
    return _items(call).pop(0) if _items(call) else NIL


def _unshift(call: Call, *values: Value) -> Value:
    call.changeable()
    call.run.budget.spend_items(len(_items(call)))
    _items(call)[:0] = values
    return call.receiver


def _plus(call: Call, other: Value) -> Value:
    more = call.array(other).items
    return call.run.array(_items(call) + more, call.receiver, other)


def _minus(call: Call, other: Value) -> Value:
    drop = call.array(other).items
    kept = [item for item in _items(call) if not any(call.equal(item, d) for d in drop)]
    return call.run.array(kept, call.receiver, other)


def _times(call: Call, factor: Value) -> Value:
    if isinstance(factor.data, RubyString):
        return _join(call, factor)
    count = call.integer(factor)
    if count < 0:
        raise call.refuse("with a negative number")
    call.run.budget.spend_items(len(_items(call)) * count)
    return call.run.array(_items(call) * (count if _items(call) else 0), call.receiver, factor)


def _join(call: Call, separator: Value | None = None) -> Value:
    between = call.traced(separator) if separator is not None else TracedString()
    parts: list[TracedString] = []
    for text in _written(call, _items(call), 0):
        call.run.budget.spend_items(len(between.pieces))
        parts += [between, text] if parts else [text]
    return call.run.string(joined(parts).influenced(call.receiver.parameters))


def _written(call: Call, items: list[Value], depth: int) -> list[TracedString]:
    found: list[TracedString] = []
    if depth > _MAX_NESTING:
        raise call.refuse("with arrays nested too deeply")
    for item in items:
        call.run.budget.spend()
        if isinstance(item.data, RubyArray):
            found += _written(call, item.data.items, depth + 1)
        else:
            found.append(call.run.written(item, call.span))
    return found


def _reverse(call: Call) -> Value:
    return call.run.array(_items(call)[::-1], call.receiver)


def _last(call: Call, count: Value | None = None) -> Value:
    items = _items(call)
    if count is not None:
        number = call.integer(count)
        return call.run.array(items[len(items) - number :] if number < len(items) else items[:])
    return items[-1] if items else NIL


def _index(call: Call, wanted: Value) -> Value:
    call.run.budget.spend_items(len(_items(call)))
    for index, item in enumerate(_items(call)):
        if call.equal(item, wanted):
            return call.value(index, wanted)
    return NIL


def _compact(call: Call) -> Value:
    return call.run.array([i for i in _items(call) if i.data is not None], call.receiver)


def _flatten(call: Call) -> Value:
    def flat(items: list[Value], depth: int) -> list[Value]:
        if depth > _MAX_NESTING:
            raise call.refuse("with arrays nested too deeply")
        found: list[Value] = []
        for item in items:
            call.run.budget.spend()
            found += (
                flat(item.data.items, depth + 1) if isinstance(item.data, RubyArray) else [item]
            )
        return found

    return call.run.array(flat(_items(call), 0), call.receiver)


def _transpose(call: Call) -> Value:
    rows = [listed(call.run, row, call.node) for row in _items(call)]
    if len({len(row) for row in rows}) > 1:
        raise Unreadable(call.span, "transposes rows of different lengths")
    columns = [call.run.array(list(column)) for column in zip(*rows, strict=True)]
    return call.run.array(columns, call.receiver)


ARRAY: Methods = {
    "[]": _at,
    "at": _at,
    "slice": _at,
    "length": lambda call: call.value(len(_items(call))),
    "size": lambda call: call.value(len(_items(call))),
    "empty?": lambda call: call.value(not _items(call)),
    "any?": lambda call: call.value(any(item.truthy for item in _items(call))),
    "<<": _push,
    "push": _push,
    "append": _push,
    "concat": _concat,
    "pop": _pop,
    "shift": _shift,
    "unshift": _unshift,
    "prepend": _unshift,
    "+": _plus,
    "-": _minus,
    "*": _times,
    "join": _join,
    "reverse": _reverse,
    "last": _last,
    "index": _index,
    "compact": _compact,
    "flatten": _flatten,
    "transpose": _transpose,
}
