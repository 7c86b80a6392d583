"""Methods of collections: arrays, hashes and ranges."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from checker.launch.spawner.limits import CHARACTERS_PER_STEP
from checker.launch.spawner.methods.call import Call, Method, Methods
from checker.launch.spawner.methods.number import calculate
from checker.launch.spawner.signals import Unreadable
from checker.launch.spawner.values import (
    RubyArray,
    RubyHash,
    RubyRange,
    RubyString,
    Value,
    class_name,
    is_number,
    truthy,
)
from checker.source.ruby import RubyNode

if TYPE_CHECKING:
    from checker.launch.spawner.evaluator.interpreter import Interpreter


def items_of(run: Interpreter, collection: Value, node: RubyNode) -> Iterator[Value]:
    """Yield elements, numbers, or pairs of key and value, as `each` does.

    An array that grows meanwhile is followed; a hash must not grow, as in Ruby.

    Raises:
        Unreadable: The value is no collection.
    """
    if isinstance(collection, RubyArray):
        at = 0
        while at < len(collection.items):
            yield collection.items[at]
            at += 1
    elif isinstance(collection, RubyRange):
        yield from collection.numbers
    elif isinstance(collection, RubyHash):
        size = len(collection.entries)
        run.budget.spend_items(size)
        for key, value in list(collection.entries.values()):
            yield run.array([key, value])
            if len(collection.entries) > size:
                raise Unreadable(node.span, "adds to a hash while walking through it")
    else:
        raise Unreadable(node.span, f"walks through {class_name(collection)}")


def _listed(call: Call, collection: Value) -> list[Value]:
    """Return all elements at once."""
    if isinstance(collection, RubyRange):
        call.run.budget.spend(collection.count)
    elif isinstance(collection, RubyArray):
        call.run.budget.spend_items(len(collection.items))
    elif isinstance(collection, RubyHash):
        call.run.budget.spend(len(collection.entries))
    return list(items_of(call.run, collection, call.node))


def _all(call: Call) -> list[Value]:
    return _listed(call, call.receiver)


def _each(call: Call) -> Value:
    for item in items_of(call.run, call.receiver, call.node):
        call.block_value(item)
    return call.receiver


def _each_with_index(call: Call) -> Value:
    for index, item in enumerate(items_of(call.run, call.receiver, call.node)):
        call.block_value(item, index)
    return call.receiver


def _answers(call: Call) -> Iterator[tuple[Value, Value]]:
    """Yield each element, and what the block answers to it."""
    for item in _all(call):
        yield item, call.block_value(item)


def _filtered(truth: bool) -> Method:
    def filtered(call: Call) -> Value:
        if isinstance(call.receiver, RubyHash):
            raise call.refuse()
        kept = [item for item, value in _answers(call) if truthy(value) is truth]
        return call.run.array(kept)

    return filtered


def _first(call: Call, count: Value = None) -> Value:
    items = _all(call)
    if call.arguments:
        return call.run.array(items[: max(0, call.integer(count))])
    return items[0] if items else None


def last(call: Call) -> Value:
    """Return the last element, nil when there is none."""
    items = _all(call)
    return items[-1] if items else None


def _sum(call: Call) -> Value:
    items = _all(call)
    numbers = [call.number(item) for item in items]
    if any(isinstance(number, float) for number in numbers):
        return _compensated(numbers)
    return calculate("+", 0, sum(numbers))


def _compensated(numbers: list[int | float]) -> float:
    """Add floats as `Array#sum` does: with Neumaier's (Kahan-Babuska) compensation."""
    total, lost = 0.0, 0.0
    for number in numbers:
        after = total + number
        if abs(total) >= abs(number):
            lost += (total - after) + number
        else:
            lost += (number - after) + total
        total = after
    return total + lost


def _extreme(choose: Callable[..., Any]) -> Method:
    def extreme(call: Call) -> Value:
        items = _all(call)
        if not items:
            return None
        if not all(is_number(item) for item in items):
            raise call.refuse("with something other than numbers")
        chosen: Value = choose(items, key=lambda item: item)
        return call.number(chosen)

    return extreme


def _includes(call: Call, element: Value) -> Value:
    return any(call.run.equal(item, element, call.span) for item in _all(call))


def _sort(call: Call) -> Value:
    items = _all(call)
    call.run.budget.spend(len(items))
    if all(is_number(item) for item in items):
        return call.run.array(sorted(items, key=call.number))
    if not all(isinstance(item, RubyString) for item in items):
        raise call.refuse("with mixed values")
    texts = [call.text(item) for item in items]
    call.run.budget.spend(sum(map(len, texts)) // CHARACTERS_PER_STEP)
    return call.run.array(sorted(items, key=lambda item: call.string(item).text))


def _zip(call: Call, *others: Value) -> Value:
    items, columns = _all(call), [_listed(call, other) for other in others]
    rows = [
        call.run.array([item, *(col[i] if i < len(col) else None for col in columns)])
        for i, item in enumerate(items)
    ]
    return call.run.array(rows)


ENUMERABLE: Methods = {
    "to_a": lambda call: call.run.array(_all(call)),
    "count": lambda call: len(_all(call)),
    "first": _first,
    "include?": _includes,
    "max": _extreme(max),
    "min": _extreme(min),
    "sort": _sort,
    "sum": _sum,
    "zip": _zip,
}

ENUMERABLE_WITH_BLOCK: Methods = {
    "all?": lambda call: all(truthy(value) for _, value in _answers(call)),
    "any?": lambda call: any(truthy(value) for _, value in _answers(call)),
    "each": _each,
    "each_with_index": _each_with_index,
    "find": lambda call: next((item for item, value in _answers(call) if truthy(value)), None),
    "map": lambda call: call.run.array([value for _, value in _answers(call)]),
    "reject": _filtered(False),
    "select": _filtered(True),
}

RANGE: Methods = {"last": last, "size": ENUMERABLE["count"]}
