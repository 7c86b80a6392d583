"""Which of Ruby's errors `rescue` catches."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_PARENTS: Mapping[str, str] = MappingProxyType(
    {
        "ScriptError": "Exception",
        "LoadError": "ScriptError",
        "StandardError": "Exception",
        "ArgumentError": "StandardError",
        "EncodingError": "StandardError",
        "FloatDomainError": "RangeError",
        "FrozenError": "RuntimeError",
        "IndexError": "StandardError",
        "IOError": "StandardError",
        "KeyError": "IndexError",
        "NameError": "StandardError",
        "NoMethodError": "NameError",
        "NotImplementedError": "ScriptError",
        "RangeError": "StandardError",
        "RuntimeError": "StandardError",
        "SystemCallError": "StandardError",
        "Errno::ENOENT": "SystemCallError",
        "TypeError": "StandardError",
        "ZeroDivisionError": "StandardError",
    }
)

ERROR_CLASSES = frozenset(_PARENTS) | {"Exception"}


def is_kind(kind: str, wanted: str) -> bool:
    """Whether an error class is `wanted` or below it."""
    while kind != wanted:
        if kind not in _PARENTS:
            return False
        kind = _PARENTS[kind]
    return True


def rescued_by_default(kind: str) -> bool:
    """Whether a `rescue` without class names catches it."""
    return is_kind(kind, "StandardError")
