"""From a receiver's class and a method's name to the function that answers."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from checker.expand.spawner.methods.array import ARRAY
from checker.expand.spawner.methods.call import Call, Methods, check_arity
from checker.expand.spawner.methods.classes import CLASSES, ERROR
from checker.expand.spawner.methods.common import COMMON, NOTHING, SYMBOL
from checker.expand.spawner.methods.enumerable import ENUMERABLE, ENUMERABLE_WITH_BLOCK
from checker.expand.spawner.methods.file import FILE
from checker.expand.spawner.methods.hash import HASH, HASH_WITH_BLOCK
from checker.expand.spawner.methods.mathematics import MATH
from checker.expand.spawner.methods.number import (
    FLOAT,
    INTEGER,
    INTEGER_WITH_BLOCK,
    NUMBER,
)
from checker.expand.spawner.methods.range import RANGE
from checker.expand.spawner.methods.string import STRING, STRING_WITH_BLOCK
from checker.expand.spawner.methods.yaml_file import YAML_FILE
from checker.expand.spawner.values import (
    Constant,
    Data,
    RubyArray,
    RubyHash,
    RubyRange,
    RubyString,
    Value,
    class_name,
)

_MODULES: Mapping[str, Methods] = MappingProxyType(
    {"File": FILE, "YAML": YAML_FILE, "Psych": YAML_FILE, "Math": MATH}
)


def invoke_method(call: Call) -> Value:
    """Answer a method call.

    Raises:
        Unreadable: The method is not in the whitelist.
        RubyError: Ruby refuses the call.
    """
    for methods in _tables(call.receiver.data, with_block=call.block is not None):
        method = methods.get(call.name)
        if method is not None:
            check_arity(call, method)
            return method(call, *call.arguments)
    raise call.refuse()


def _tables(data: Data, *, with_block: bool) -> tuple[Methods, ...]:
    """Return the tables to look in; a method that takes a block stands in tables of its own."""
    if isinstance(data, Constant):
        module = _MODULES.get(data.name)
        return (CLASSES,) if module is None or with_block else (module, CLASSES)
    if with_block:
        return _with_block(data)
    return (*_OWN.get(class_name(data), ()), COMMON)


_OWN: Mapping[str, tuple[Methods, ...]] = MappingProxyType(
    {
        "String": (STRING,),
        "Array": (ARRAY, ENUMERABLE),
        "Hash": (HASH, ENUMERABLE),
        "Range": (RANGE, ENUMERABLE),
        "Symbol": (SYMBOL,),
        "Exception": (ERROR,),
        "NilClass": (NOTHING,),
        "Integer": (INTEGER, NUMBER),
        "Float": (FLOAT, NUMBER),
    }
)


def _with_block(data: Data) -> tuple[Methods, ...]:
    if isinstance(data, RubyString):
        return (STRING_WITH_BLOCK,)
    if isinstance(data, RubyHash):
        return HASH_WITH_BLOCK, ENUMERABLE_WITH_BLOCK
    if isinstance(data, (RubyArray, RubyRange)):
        return (ENUMERABLE_WITH_BLOCK,)
    if isinstance(data, int) and not isinstance(data, bool):
        return (INTEGER_WITH_BLOCK,)
    return ()
