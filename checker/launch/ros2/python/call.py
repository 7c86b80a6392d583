"""A call of a function of Python's library or of ROS, as the functions that evaluate it see it."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.launch.ros2.python.expressions import each
from checker.launch.ros2.values import (
    FilePath,
    Made,
    PlacedText,
    Unknown,
    Value,
    chosen_value,
    span_of,
)
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter


class NotKnown(Exception):
    """Raised when the value of a call is not known; its only argument is that `Unknown`."""


class Call(Record, eq=False):
    """A call with the values of its arguments.

    Attributes:
        run: The evaluation of the launch file.
        node: The call, or the expression that stands for one.
        arguments: Arguments by place.
        named: Arguments by name.
    """

    run: Interpreter
    node: ast.AST
    arguments: list[Value]
    named: dict[str, Value]

    @property
    def span(self) -> Span:
        """The place of the call."""
        return self.run.span(self.node)

    def first(self, *names: str) -> Value:
        """Return the first argument, given by place or by one of some names."""
        if self.arguments:
            return self.arguments[0]
        return next((self.named[name] for name in names if name in self.named), None)

    def items(self, value: Value) -> list[Value]:
        """Return the items of a value; one unknown item if the value is unknown."""
        return each(self.run, value, self.node)

    def text(self, value: Value) -> PlacedText:
        """Return a path or name as text.

        Raises:
            NotKnown: The value is not a text that is known.
        """
        value = chosen_value(value)
        if isinstance(value, FilePath):
            return self.placed(value.text)
        if isinstance(value, str):
            return PlacedText(value, span_of(value, self.span))
        if isinstance(value, Unknown):
            raise NotKnown(value)
        if isinstance(value, Made):
            raise self.not_known(f"a text is made of a {value.name} before the launch")
        raise self.not_known("is not text")

    def texts(self, values: Iterable[Value]) -> list[PlacedText]:
        """Return several values as text.

        Raises:
            NotKnown: One of them is not a text that is known.
        """
        return [self.text(value) for value in values]

    def placed(self, text: str) -> PlacedText:
        """Return a text that the call makes."""
        return PlacedText(text, self.span)

    def unknown(self, reason: str) -> Unknown:
        """Return a value that is not known."""
        return self.run.unknown(self.node, reason)

    def not_known(self, reason: str) -> NotKnown:
        """Return the exception that ends the evaluation of the call."""
        return NotKnown(self.unknown(reason))

    def evaluated(self, work: Work) -> Value:
        """Return the value of the call; an `Unknown` if it is not known."""
        try:
            return work(self)
        except NotKnown as end:
            return end.args[0]


Work = Callable[[Call], Value]
"""Returns the value of a call, or raises `NotKnown`."""
