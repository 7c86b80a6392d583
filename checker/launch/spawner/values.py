"""Ruby's values.

Strings, arrays and hashes are shared by reference and can be changed, as in Ruby.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias, TypeGuard

from checker.base.record import Record
from checker.launch.spawner.limits import CHARACTERS_PER_STEP, Budget
from checker.launch.spawner.literals import TracedString
from checker.source.ruby import RubyNode

if TYPE_CHECKING:
    from checker.launch.spawner.scope import Scope


@dataclass(eq=False, slots=True)
class RubyString:
    """A string that `<<` changes in place."""

    content: TracedString
    frozen: bool = False

    @property
    def text(self) -> str:
        """The characters."""
        return self.content.text


class Symbol(Record):
    """`:name`."""

    name: str


@dataclass(eq=False, slots=True)
class RubyArray:
    """An array."""

    items: list[Value] = field(default_factory=list)
    frozen: bool = False


@dataclass(eq=False, slots=True)
class RubyHash:
    """A hash; `entries` maps the identity of a key (`key_of`) to the key and its value."""

    entries: dict[Hashable, tuple[Value, Value]] = field(default_factory=dict)
    default: Value | None = None
    frozen: bool = False


class RubyRange(Record):
    """`first..last`, or `first...last` without its last number."""

    first: int
    last: int
    exclusive: bool

    @property
    def numbers(self) -> range:
        """The numbers in it; there may be more than `len` can state."""
        return range(self.first, self.last if self.exclusive else self.last + 1)

    @property
    def count(self) -> int:
        """Count of the numbers in it."""
        return max(0, self.numbers.stop - self.first)

    def bounds_in(self, length: int) -> tuple[int, int] | None:
        """Return start and end of the part of a list, or None where Ruby gives nil."""
        start = self.first + length if self.first < 0 else self.first
        last = self.last + length if self.last < 0 else self.last
        if not 0 <= start <= length:
            return None
        return start, max(start, min(last if self.exclusive else last + 1, length))


class Constant(Record):
    """A class or module of Ruby: `File`, `Math`, `StandardError`."""

    name: str


class ErrorValue(Record):
    """Error that `rescue => error` assigns."""

    kind: str
    message: str


class Block(Record, eq=False):
    """`{ |x| … }` with the variables around it, or `&:method`."""

    node: RubyNode
    scope: Scope | None = None
    method: str = ""


Value: TypeAlias = (
    bool
    | int
    | float
    | RubyString
    | Symbol
    | RubyArray
    | RubyHash
    | RubyRange
    | Constant
    | ErrorValue
    | None
)


def truthy(value: Value) -> bool:
    """Return whether a condition holds; it does for everything but nil and false."""
    return value is not None and value is not False


_CLASSES: tuple[tuple[type, str], ...] = (
    (int, "Integer"),
    (float, "Float"),
    (RubyString, "String"),
    (Symbol, "Symbol"),
    (RubyArray, "Array"),
    (RubyHash, "Hash"),
    (RubyRange, "Range"),
    (Constant, "Class"),
    (ErrorValue, "Exception"),
)


def class_name(value: Value) -> str:
    """Return the name of Ruby's class of a value."""
    if value is None:
        return "NilClass"
    if isinstance(value, bool):
        return "TrueClass" if value else "FalseClass"
    return next(name for kind, name in _CLASSES if isinstance(value, kind))


def is_number(value: Value) -> TypeGuard[int | float]:
    """Return whether a value is an integer or a float; true and false are not numbers."""
    return type(value) in {int, float}


_SAFE_INTEGER = 2**60
"""Python's hashes of integers repeat at 2**61 - 1; those of texts cannot be foreseen."""


def key_of(value: Value, budget: Budget) -> Hashable:
    """Return what makes two hash keys equal: 1 and 1.0 are two keys, 'a' and :a too.

    Raises:
        LimitReached: No steps are left.
        ValueError: Arrays and hashes are no keys that spawners use.
    """
    budget.spend()
    if isinstance(value, RubyString):
        budget.spend_text(len(value.text))
        return "String", value.text
    if isinstance(value, (RubyArray, RubyHash)):
        raise ValueError(class_name(value))
    if isinstance(value, int) and abs(value) > _SAFE_INTEGER:
        return class_name(value), hex(value)
    return class_name(value), value


def equal(left: Value, right: Value, budget: Budget) -> bool:
    """Compare as Ruby's `==` does.

    Raises:
        LimitReached: No steps are left.
        ValueError: Two arrays or two hashes: spawners compare none.
    """
    budget.spend()
    if isinstance(left, RubyString) and isinstance(right, RubyString):
        budget.spend(min(len(left.text), len(right.text)) // CHARACTERS_PER_STEP)
        return left.text == right.text
    if isinstance(left, (RubyArray, RubyHash)) and type(left) is type(right):
        raise ValueError(class_name(left))
    if isinstance(left, bool) or isinstance(right, bool):
        return left is right
    return left == right
