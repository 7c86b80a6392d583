"""One call of a method: receiver, arguments, block, and how to answer it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from checker.launch.spawner.literals import TracedString
from checker.launch.spawner.scope import Scope
from checker.launch.spawner.signals import Continued, RubyError, Unreadable
from checker.launch.spawner.values import (
    Block,
    Constant,
    RubyArray,
    RubyHash,
    RubyString,
    Value,
    class_name,
)
from checker.source.ruby import RubyNode
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.launch.spawner.evaluator.interpreter import Interpreter

Method: TypeAlias = Callable[..., Value]
Methods: TypeAlias = Mapping[str, Method]

_VARIADIC = 0x04
"""The flag of a Python function that takes `*arguments`."""


@dataclass(eq=False, slots=True)
class Call:
    """A call while it is answered.

    Attributes:
        run: The interpreter.
        node: The whole call.
        name: The name of the method.
        receiver: The object before the dot.
        arguments: Positional arguments.
        named: Arguments with a name (`radius: 1`).
        block: `{ … }` or `do … end`.
        at: The place, when it is not the node's.
    """

    run: Interpreter
    node: RubyNode
    name: str
    receiver: Value
    arguments: list[Value] = field(default_factory=list)
    named: dict[str, Value] = field(default_factory=dict)
    block: Block | None = None
    at: Span | None = None

    @property
    def span(self) -> Span:
        """The place of the call."""
        return self.at or self.node.span

    @property
    def title(self) -> str:
        """`String#chomp`, `File.write` for a class, or the bare name of a function."""
        data = self.receiver
        if self.node.type in {"call", "identifier"} and "receiver" not in self.node.fields:
            return self.name
        if isinstance(data, Constant):
            return f"{data.name}.{self.name}"
        return f"{class_name(data)}#{self.name}"

    def refuse(self, why: str = "which is not supported") -> Unreadable:
        """Return the exception that states that this call is outside the subset."""
        return Unreadable(self.span, f"calls {self.title}, {why}")

    def string(self, value: Value) -> RubyString:
        """Return an argument that has to be a string."""
        if not isinstance(value, RubyString):
            raise self.refuse(f"with {class_name(value)} instead of a string")
        return value

    def text(self, value: Value) -> str:
        """Return the characters of an argument that has to be a string.

        What is done with them takes a time that grows with their number.
        """
        text = self.string(value).text
        self.run.budget.spend_text(len(text))
        return text

    def traced(self, value: Value) -> TracedString:
        """Return the pieces of an argument that has to be a string."""
        self.string(value)
        return self.run.traced(value, self.span)

    def integer(self, value: Value) -> int:
        """Return an argument that has to be an integer."""
        if type(value) is not int:
            raise self.refuse(f"with {class_name(value)} instead of an integer")
        return value

    def number(self, value: Value) -> int | float:
        """Return an argument that has to be a number."""
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.refuse(f"with {class_name(value)} instead of a number")
        return value

    def truncate(self, number: int | float) -> int:
        """Return a number without what is behind its point.

        Raises:
            RubyError: It is not finite.
        """
        if not math.isfinite(number):
            text = "NaN" if math.isnan(number) else "Infinity" if number > 0 else "-Infinity"
            raise RubyError("FloatDomainError", text, self.span)
        return int(number)

    def array(self, value: Value) -> RubyArray:
        """Return an argument that has to be an array."""
        if not isinstance(value, RubyArray):
            raise self.refuse(f"with {class_name(value)} instead of an array")
        return value

    def hash(self, value: Value) -> RubyHash:
        """Return an argument that has to be a hash."""
        if not isinstance(value, RubyHash):
            raise self.refuse(f"with {class_name(value)} instead of a hash")
        return value

    def changeable(self) -> None:
        """Make sure that the receiver may be changed.

        Raises:
            RubyError: It is frozen.
        """
        data = self.receiver
        if isinstance(data, (RubyString, RubyArray, RubyHash)) and data.frozen:
            raise RubyError("FrozenError", f"can't modify frozen {class_name(data)}", self.span)

    def block_value(self, *arguments: Value) -> Value:
        """Run the block once."""
        return invoke_block(self, list(arguments))


def check_arity(call: Call, method: Method) -> None:
    """Make sure that a method of the whitelist knows this number of arguments.

    Raises:
        Unreadable: It does not.
    """
    code = method.__code__
    most = code.co_argcount - 1
    least = most - len(method.__defaults__ or ())
    count = len(call.arguments)
    if count < least or (count > most and not code.co_flags & _VARIADIC):
        raise call.refuse(f"with {count} arguments")
    if call.named:
        raise call.refuse("with named arguments")


def invoke_block(call: Call, arguments: list[Value]) -> Value:
    """Run a block with arguments; one array is taken apart when the block names several.

    Raises:
        Unreadable: There is no block, or it is outside the subset.
    """
    block, run = call.block, call.run
    if block is None:
        raise call.refuse("without a block")
    run.budget.spend()
    if block.scope is None:
        return run.invoke(Call(run, block.node, block.method, arguments[0], arguments[1:]))
    if block.node.broken:
        raise Unreadable(block.node.span, "contains Ruby that the parser does not understand")
    around = block.scope
    scope = Scope(around.path, {}, around, around.call, block)
    parameters = block.node.fields.get("parameters")
    targets = parameters.parts if parameters else []
    run.budget.spend_items(len(targets))
    _bind(call, scope, targets, arguments)
    body = block.node.fields.get("body")
    try:
        with run.inside(scope):
            return run.evaluate(body) if body else None
    except Continued as jump:
        if jump.scope is not scope:
            raise
        return jump.value


def _bind(call: Call, scope: Scope, targets: list[RubyNode], arguments: list[Value]) -> None:
    if len(arguments) == 1 and isinstance(arguments[0], RubyArray) and _several(targets):
        call.run.budget.spend_items(len(arguments[0].items))
        arguments = list(arguments[0].items)
    for index, target in enumerate(targets):
        value = arguments[index] if index < len(arguments) else None
        if target.type == "identifier":
            scope.variables[target.text] = value
        elif target.type == "destructured_parameter":
            items = value.items if isinstance(value, RubyArray) else [value]
            call.run.budget.spend_items(len(items))
            _bind(call, scope, target.parts, list(items))
        else:
            raise Unreadable(target.span, f"has the block parameter {target.text[:40]}")


def _several(targets: list[RubyNode]) -> bool:
    return len(targets) > 1 or any(target.type == "destructured_parameter" for target in targets)
