"""Methods of Range."""

from __future__ import annotations

from checker.expand.spawner.methods.call import Call, Methods
from checker.expand.spawner.values import RubyRange, Value


def _range(call: Call) -> RubyRange:
    if not isinstance(call.receiver.data, RubyRange):
        raise call.refuse()
    return call.receiver.data


def _last(call: Call) -> Value:
    return call.value(_range(call).last)


RANGE: Methods = {
    "begin": lambda call: call.value(_range(call).first),
    "end": _last,
    "last": _last,
    "size": lambda call: call.value(_range(call).count),
    "cover?": lambda call, n: call.value(call.integer(n) in _range(call).numbers, n),
}
