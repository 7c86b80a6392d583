"""What can be walked through: arrays, hashes and ranges."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.expand.spawner.signals import Unreadable
from checker.expand.spawner.values import (
    RubyArray,
    RubyHash,
    RubyRange,
    Value,
    class_name,
)
from checker.source.ruby import RubyNode

if TYPE_CHECKING:
    from checker.expand.spawner.evaluator.interpreter import Interpreter


def items_of(run: Interpreter, collection: Value, node: RubyNode) -> Iterator[Value]:
    """Yield elements, numbers, or pairs of key and value, as `each` does.

    An array that grows meanwhile is followed; a hash must not grow, as in Ruby.

    Raises:
        Unreadable: The value is no collection.
    """
    data, parameters = collection.data, collection.parameters
    if isinstance(data, RubyArray):
        at = 0
        while at < len(data.items):
            item = data.items[at]
            yield Value(item.data, item.parameters | parameters) if parameters else item
            at += 1
    elif isinstance(data, RubyRange):
        for number in data.numbers:
            yield run.value(number, collection)
    elif isinstance(data, RubyHash):
        size = len(data.entries)
        run.budget.spend_items(size)
        for key, value in list(data.entries.values()):
            yield run.array([key, value], collection)
            if len(data.entries) > size:
                raise Unreadable(node.span, "adds to a hash while walking through it")
    else:
        raise Unreadable(node.span, f"walks through {class_name(data)}")


def listed(run: Interpreter, collection: Value, node: RubyNode) -> list[Value]:
    """Return all elements at once."""
    data = collection.data
    if isinstance(data, RubyRange):
        run.budget.spend(data.count)
    elif isinstance(data, RubyArray):
        run.budget.spend_items(len(data.items))
    elif isinstance(data, RubyHash):
        run.budget.spend(len(data.entries))
    return list(items_of(run, collection, node))
