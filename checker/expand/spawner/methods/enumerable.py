"""Methods of arrays, hashes and ranges alike."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

from checker.expand.spawner.arithmetic import calculate
from checker.expand.spawner.limits import CHARACTERS_PER_STEP
from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.methods.iteration import items_of, listed
from checker.expand.spawner.values import (
    NIL,
    RubyHash,
    RubyString,
    Value,
    class_name,
    is_number,
)


def _all(call: Call) -> list[Value]:
    return listed(call.run, call.receiver, call.node)


def _each(call: Call) -> Value:
    for item in items_of(call.run, call.receiver, call.node):
        call.each(item)
    return call.receiver


def _each_with_index(call: Call) -> Value:
    for index, item in enumerate(items_of(call.run, call.receiver, call.node)):
        call.each(item, call.run.value(index))
    return call.receiver


def _each_with_object(call: Call, memory: Value) -> Value:
    for item in items_of(call.run, call.receiver, call.node):
        call.each(item, memory)
    return memory


def _map(call: Call) -> Value:
    return call.run.array([call.each(item) for item in _all(call)], call.receiver)


def _flat_map(call: Call) -> Value:
    found: list[Value] = []
    for item in _all(call):
        value = call.each(item)
        is_list = class_name(value.data) == "Array"
        found += listed(call.run, value, call.node) if is_list else [value]
    return call.run.array(found, call.receiver)


def _filter(wanted: bool) -> Callable[[Call], Value]:
    def keep(call: Call) -> Value:
        kept = [item for item in _all(call) if call.each(item).truthy is wanted]
        if isinstance(call.receiver.data, RubyHash):
            raise call.refuse()
        return call.run.array(kept, call.receiver)

    return keep


def _find(call: Call) -> Value:
    return next((item for item in _all(call) if call.each(item).truthy), NIL)


def _any(call: Call) -> Value:
    return call.value(any(call.each(item).truthy for item in _all(call)))


def _every(call: Call) -> Value:
    return call.value(all(call.each(item).truthy for item in _all(call)))


def _inject(call: Call, first: Value | None = None) -> Value:
    items = _all(call)
    if first is None:
        if not items:
            return NIL
        first, items = items[0], items[1:]
    for item in items:
        first = call.each(first, item)
    return first


def _sum(call: Call, start: Value | None = None) -> Value:
    total: int | float = call.number(start) if start else 0
    items = _all(call)
    numbers = [call.number(item) for item in items]
    if any(isinstance(number, float) for number in [total, *numbers]):
        total = _compensated(total, numbers)
    else:
        total = calculate("+", total, sum(numbers)) or 0
    return call.value(total, *items)


def _compensated(start: float, numbers: list[int | float]) -> float:
    """Add floats as `Array#sum` does: with Neumaier's (Kahan-Babuska) compensation."""
    total, lost = float(start), 0.0
    for number in numbers:
        after = total + number
        if abs(total) >= abs(number):
            lost += (total - after) + number
        else:
            lost += (number - after) + total
        total = after
    return total + lost


def _first(call: Call, count: Value | None = None) -> Value:
    items = _all(call)
    if count is not None:
        return call.run.array(items[: max(0, call.integer(count))], call.receiver)
    return items[0] if items else NIL


def _extreme(choose: Callable[..., Any]) -> Callable[[Call], Value]:
    def find(call: Call) -> Value:
        items = _all(call)
        if not items:
            return NIL
        if not all(is_number(item) for item in items):
            raise call.refuse("with something else than numbers")
        chosen: Value = choose(items, key=lambda item: item.data)
        return call.value(call.number(chosen), *items)

    return find


def _includes(call: Call, wanted: Value) -> Value:
    if isinstance(call.receiver.data, RubyHash):
        raise call.refuse()
    return call.value(any(call.equal(item, wanted) for item in _all(call)), wanted)


def _sort_key(call: Call, items: list[Value]) -> Callable[[Value], Any]:
    if all(is_number(item) for item in items):
        return lambda item: item.data
    if all(isinstance(item.data, RubyString) for item in items):
        texts = [call.text(item) for item in items]
        call.run.budget.spend(sum(map(len, texts)) // CHARACTERS_PER_STEP)
        return lambda item: call.string(item).text
    raise call.refuse("with mixed values")


def _sort(call: Call) -> Value:
    items = _all(call)
    call.run.budget.spend(len(items))
    return call.run.array(sorted(items, key=_sort_key(call, items)), call.receiver)


def _sort_by(call: Call) -> Value:
    """Sort by distinct keys; the order of equal ones is Ruby's secret."""
    items = _all(call)
    keys = [call.each(item) for item in items]
    key = _sort_key(call, keys)
    order = sorted(range(len(items)), key=lambda index: key(keys[index]))
    if any(key(keys[one]) == key(keys[next_one]) for one, next_one in pairwise(order)):
        raise call.refuse("with equal keys")
    return call.run.array([items[index] for index in order], call.receiver)


def _zip(call: Call, *others: Value) -> Value:
    items = _all(call)
    columns = [listed(call.run, other, call.node) for other in others]
    rows = [
        call.run.array([item, *(col[i] if i < len(col) else NIL for col in columns)])
        for i, item in enumerate(items)
    ]
    return call.run.array(rows, call.receiver)


def _each_slice(call: Call, size: Value) -> Value:
    items, width = _all(call), call.integer(size)
    if width < 1:
        raise call.refuse("with a size below 1")
    for at in range(0, len(items), width):
        call.each(call.run.array(items[at : at + width], call.receiver))
    return call.receiver


ENUMERABLE: Methods = {
    "to_a": lambda call: call.run.array(_all(call), call.receiver),
    "entries": lambda call: call.run.array(_all(call), call.receiver),
    "count": lambda call: call.value(len(_all(call))),
    "first": _first,
    "sum": _sum,
    "min": _extreme(min),
    "max": _extreme(max),
    "include?": _includes,
    "member?": _includes,
    "sort": _sort,
    "zip": _zip,
}

ENUMERABLE_WITH_BLOCK: Methods = {
    "each": _each,
    "each_with_index": _each_with_index,
    "each_with_object": _each_with_object,
    "each_slice": _each_slice,
    "map": _map,
    "collect": _map,
    "flat_map": _flat_map,
    "select": _filter(True),
    "filter": _filter(True),
    "reject": _filter(False),
    "find": _find,
    "detect": _find,
    "any?": _any,
    "all?": _every,
    "inject": _inject,
    "reduce": _inject,
    "sort_by": _sort_by,
}
