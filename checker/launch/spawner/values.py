"""Ruby's values, each with the parameters that influenced it.

Strings, arrays and hashes are shared by reference and can be changed, as in Ruby.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from checker.base.record import Record
from checker.launch.spawner.limits import CHARACTERS_PER_STEP, Budget
from checker.launch.spawner.literals import TracedString
from checker.source.emitted import NO_PARAMETERS
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


Data: TypeAlias = (
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


class Value(Record, eq=False):
    """A value, and the parameters and globals that influenced which one it is.

    A string's pieces also have their own parameters.
    """

    data: Data
    parameters: frozenset[str] = NO_PARAMETERS

    @property
    def truthy(self) -> bool:
        """Everything but nil and false is true."""
        return self.data is not None and self.data is not False

    @property
    def influences(self) -> frozenset[str]:
        """The parameters that influenced the value, with those of a string's pieces."""
        if isinstance(self.data, RubyString):
            return self.parameters | self.data.content.parameters
        return self.parameters


NIL = Value(None)

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


def class_name(data: Data) -> str:
    """Return the name of Ruby's class of a value."""
    if data is None:
        return "NilClass"
    if isinstance(data, bool):
        return "TrueClass" if data else "FalseClass"
    return next(name for kind, name in _CLASSES if isinstance(data, kind))


def is_number(value: Value) -> bool:
    """Return whether a value is an integer or a float; true and false are not numbers."""
    return type(value.data) in {int, float}


_SAFE_INTEGER = 2**60
"""Python's hashes of integers repeat at 2**61 - 1; those of texts cannot be foreseen."""


def key_of(value: Value, budget: Budget) -> Hashable:
    """Return what makes two hash keys equal: 1 and 1.0 are two keys, 'a' and :a too.

    Raises:
        LimitReached: No steps are left.
        ValueError: Arrays and hashes are no keys that spawners use.
    """
    data = value.data
    budget.spend()
    if isinstance(data, RubyString):
        budget.spend_text(len(data.text))
        return "String", data.text
    if isinstance(data, (RubyArray, RubyHash)):
        raise ValueError(class_name(data))
    if isinstance(data, int) and abs(data) > _SAFE_INTEGER:
        return class_name(data), hex(data)
    return class_name(data), data


def equal(left: Data, right: Data, budget: Budget) -> bool:
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
