"""Exceptions that end an evaluation: unreadable code, Ruby's errors, and its jumps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.launch.spawner.values import Block, Value

_PARENTS: Mapping[str, str] = {
    "ScriptError": "Exception",
    "LoadError": "ScriptError",
    "NotImplementedError": "ScriptError",
    "StandardError": "Exception",
    "ArgumentError": "StandardError",
    "IOError": "StandardError",
    "IndexError": "StandardError",
    "KeyError": "IndexError",
    "NameError": "StandardError",
    "RangeError": "StandardError",
    "FloatDomainError": "RangeError",
    "RuntimeError": "StandardError",
    "FrozenError": "RuntimeError",
    "SystemCallError": "StandardError",
    "TypeError": "StandardError",
    "ZeroDivisionError": "StandardError",
}

ERROR_CLASSES = frozenset(_PARENTS) | {"Exception"}


class Unread(Record, eq=False):
    """A construct that cannot be read without running Ruby, or that is not available.

    Attributes:
        span: The construct.
        reason: Completes the sentence "the spawner …": `calls system`.
    """

    span: Span
    reason: str


class Unreadable(Exception):
    """Ends the evaluation of a function; no `rescue` of the Ruby catches it."""

    def __init__(self, span: Span, reason: str) -> None:
        super().__init__(reason)
        self.unread = Unread(span, reason)


class RubyError(Exception):
    """An error that Ruby itself would raise, so that `rescue` catches it.

    Attributes:
        kind: Ruby's class, such as `ZeroDivisionError`.
        message: Ruby's text.
        span: The expression that raises it.
    """

    def __init__(self, kind: str, message: str, span: Span) -> None:
        super().__init__(message)
        self.kind, self.message, self.span = kind, message, span

    def is_a(self, class_name: str) -> bool:
        """Return whether Ruby's class of the error is `class_name` or below it."""
        kind = self.kind
        while kind != class_name:
            if kind not in _PARENTS:
                return False
            kind = _PARENTS[kind]
        return True


class Returned(Exception):
    """`return`: leaves the function whose call is `frame`."""

    def __init__(self, frame: object, value: Value) -> None:
        super().__init__()
        self.frame, self.value = frame, value


class Broken(Exception):
    """`break`: leaves the loop, or the call that was given `block`."""

    def __init__(self, scope: object, block: Block | None, value: Value) -> None:
        super().__init__()
        self.scope, self.block, self.value = scope, block, value


class Continued(Exception):
    """`next`: ends one round of the loop or of the block."""

    def __init__(self, scope: object, value: Value) -> None:
        super().__init__()
        self.scope, self.value = scope, value
