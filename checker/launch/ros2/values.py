"""Values in launch files: texts with their place, substitutions, actions, and unknowns.

Besides these, values are Python's own: numbers, truth values, None, lists, tuples, dictionaries.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from checker.base.record import Record
from checker.launch.ros2.classes import SUBSTITUTIONS
from checker.launch.ros2.graph import Condition
from checker.source.text import Span

Value = Any
"""A text, a number, a list …, or one of the classes below."""


class LaunchLimit(Exception):
    """A launch file that exceeds a limit; the limit as a predicate."""


MAX_STEPS = 200_000
"""Nodes evaluated, items taken, actions visited: of one launch file and all that it includes."""
MAX_TEXT = 100_000
"""Characters of a text that is made."""
MAX_DEPTH = 60
"""Expressions, calls, groups and files within one another."""
_CHARACTERS_A_STEP = 64


class HandledError(Exception):
    """An error of Python in a launch file that a `try` around it handles.

    Attributes:
        names: The names of its class and of those above it.
    """

    def __init__(self, names: frozenset[str]) -> None:
        """Raise an error of such a class."""
        super().__init__()
        self.names = names


class Allowance:
    """Steps and levels that are left to one launch file and all that it includes."""

    def __init__(self, steps: int = MAX_STEPS) -> None:
        """Begin with so many steps."""
        self._left = steps
        self._depth = 0

    def spend(self, steps: int = 1) -> None:
        """Take steps.

        Raises:
            LaunchLimit: No steps are left.
        """
        self._left -= steps
        if self._left < 0:
            raise LaunchLimit(f"takes more than {MAX_STEPS} steps to evaluate")

    def spend_on_text(self, length: int) -> None:
        """Take the steps of making a text of so many characters.

        Raises:
            LaunchLimit: It is too long, or no steps are left.
        """
        if length > MAX_TEXT:
            raise LaunchLimit(f"makes a text of more than {MAX_TEXT} characters")
        self.spend(1 + length // _CHARACTERS_A_STEP)

    def __enter__(self) -> None:
        """Go one level down.

        Raises:
            LaunchLimit: The value is too deep.
        """
        if self._depth >= MAX_DEPTH:
            raise LaunchLimit(f"is nested more than {MAX_DEPTH} levels deep")
        self._depth += 1

    def __exit__(self, *_: object) -> None:
        """Go up again."""
        self._depth -= 1


class PlacedText(str):
    """A text and the place where it is written.

    Attributes:
        span: The literal, or the expression that makes it.
    """

    __slots__ = ("span",)
    span: Span

    def __new__(cls, text: str, span: Span) -> PlacedText:
        """Place a text."""
        self = super().__new__(cls, text)
        self.span = span
        return self


CONTENT = "$(file-content "
REPLACING = " replacing"


class FileText(PlacedText):
    """The whole text of a file: `$(file-content PATH)`.

    Behind the path, `replacing` says that the launch file replaces parts of the text.

    Attributes:
        path: The path of the file.
    """

    __slots__ = ("path",)
    path: str

    @classmethod
    def read(cls, path: str, span: Span) -> FileText:
        """Return the text of a file."""
        self = cls(f"{CONTENT}{path})", span)
        self.path = path
        return self

    def replaced(self) -> FileText:
        """Return the text after `replace`."""
        text = FileText(f"{CONTENT}{self.path}{REPLACING})", self.span)
        text.path = self.path
        return text


class Unknown(Record, eq=False):
    """A value that this reader cannot evaluate; the reason ends a sentence."""

    reason: str
    span: Span


class Inert(Unknown, eq=False):
    """An object of a class of the launch file that uses nothing of the launch system."""


class Symbol(Record):
    """Imported name, as its dotted path: `launch.actions.Node`."""

    path: str

    @property
    def root(self) -> str:
        """The package that it comes from."""
        return self.path.partition(".")[0]

    @property
    def last(self) -> str:
        """Its own name."""
        return self.path.rpartition(".")[2]


class FilePath(Record):
    """A `pathlib.Path`."""

    text: str


class OpenFile(Record):
    """Result of `open`."""

    path: str


@dataclass(eq=False)
class Made:
    """An object of the launch system: an action, a substitution, a condition, an event handler.

    Attributes:
        name: The name of its class, such as `Node`.
        values: Arguments by name.
        span: The call, or the element.
        keywords: The place of each argument, if not that of its value.
        rest: Positional arguments that the class does not have.
    """

    name: str
    values: dict[str, Value]
    span: Span
    keywords: dict[str, Span] = field(default_factory=dict)
    rest: tuple[Value, ...] = ()


def is_substitution(value: Value) -> bool:
    """Return whether a value is a substitution, whose text is known only to launch."""
    return isinstance(value, Made) and value.name in SUBSTITUTIONS


class Guarded(Record, eq=False):
    """A value that is there only under conditions that are tested while the file is read."""

    value: Value
    conditions: tuple[Condition, ...]

    @property
    def holds(self) -> bool | None:
        """True if it is there with the defaults; None if that is not known."""
        states = [condition.holds for condition in self.conditions]
        if any(state is False for state in states):
            return False
        return None if any(state is None for state in states) else True


class Choice(Record, eq=False):
    """One of several values, by conditions that could not be decided."""

    values: tuple[Guarded, ...]


def chosen_value(value: Value) -> Value:
    """Return the value that counts with the defaults, of one that is guarded or chosen."""
    while isinstance(value, Guarded | Choice):
        if isinstance(value, Guarded):
            if value.holds is not True:
                return Unknown(_undecided(value), value.conditions[0].text.span)
            value = value.value
        else:
            standing = [item for item in value.values if item.holds is True]
            if not standing:
                first = value.values[0]
                return Unknown(_undecided(first), first.conditions[0].text.span)
            value = standing[0].value
    return value


def _undecided(value: Guarded) -> str:
    condition = next((c for c in value.conditions if c.holds is not True), value.conditions[0])
    return f"depends on {condition.text.value[:80]!r}"


def add_place(value: Value, span: Span) -> Value:
    """Return a value; a text without a place is given one."""
    return PlacedText(value, span) if type(value) is str else value


def span_of(value: Value, default: Span) -> Span:
    """Return the place of a value."""
    if isinstance(value, PlacedText | Unknown | Made):
        return value.span
    if isinstance(value, list | tuple) and value:
        return span_of(value[0], default)
    return default
