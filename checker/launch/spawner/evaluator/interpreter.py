"""The state of one evaluation, and the one way from a node to its value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeAlias

from checker.launch.spawner.files import SpawnerFiles
from checker.launch.spawner.limits import (
    ITEMS_PER_STEP,
    MAX_DEPTH,
    MAX_FILE_LENGTH,
    Budget,
    LimitReached,
)
from checker.launch.spawner.literals import TracedString, computed_string, join_strings
from checker.launch.spawner.methods.call import Call
from checker.launch.spawner.methods.classes import invoke_method
from checker.launch.spawner.scope import Function, Scope
from checker.launch.spawner.signals import Unreadable
from checker.launch.spawner.value_text import NotWritable, interpolate
from checker.launch.spawner.values import RubyArray, RubyString, Value, equal
from checker.source.ruby import ParsesTooSlowly, RubyNode, parse_ruby
from checker.source.text import SourceText, Span

Handler: TypeAlias = "Callable[[Interpreter, RubyNode], Value]"


@dataclass(eq=False)
class Interpreter:
    """One run of a spawner.

    Attributes:
        files: The workspace.
        handlers: What each type of node means.
        trees: Parsed files by path, shared by all runs of a spawner.
        budget: Steps that are left.
        functions: Functions defined so far.
        globals: Global variables by name, with `$`.
        constants: Constants of the spawner.
        loaded: Paths of the Ruby files run so far.
        sources: Texts read so far, by path.
        scope: Variables that the present code sees.
        depth: Evaluations that wait for each other.
        calls: Ruby functions that wait for each other.
    """

    files: SpawnerFiles
    handlers: Mapping[str, Handler]
    trees: dict[str, RubyNode]
    budget: Budget = field(default_factory=Budget)
    functions: dict[str, Function] = field(default_factory=dict)
    globals: dict[str, Value] = field(default_factory=dict)
    constants: dict[str, Value] = field(default_factory=dict)
    loaded: set[str] = field(default_factory=set)
    sources: dict[str, SourceText] = field(default_factory=dict)
    scope: Scope = field(init=False)
    depth: int = 0
    calls: int = 0

    def evaluate(self, node: RubyNode) -> Value:
        """Return the value of an expression or statement.

        Raises:
            Unreadable: The node is outside the subset, or a limit is reached.
            RubyError: Ruby would raise an error.
        """
        handler = self.handlers.get(node.type)
        if handler is None or (node.broken and node.type != "method"):
            raise Unreadable(node.span, _unknown(node))
        if self.depth >= MAX_DEPTH:
            raise Unreadable(node.span, f"is nested more than {MAX_DEPTH} levels deep")
        self.depth += 1
        try:
            self.budget.spend(1 + len(node.children) // ITEMS_PER_STEP)
            return handler(self, node)
        except LimitReached as limit:
            raise Unreadable(node.span, str(limit)) from None
        finally:
            self.depth -= 1

    def invoke(self, call: Call) -> Value:
        """Return what a method of an object returns.

        Raises:
            Unreadable: The method is not in the whitelist.
            RubyError: Ruby refuses the call.
        """
        return invoke_method(call)

    def run(self, statements: Iterable[RubyNode]) -> Value:
        """Evaluate statements in order; the last one's value counts."""
        value = None
        for node in statements:
            value = self.evaluate(node)
        return value

    def string(self, content: TracedString, *, frozen: bool = False) -> Value:
        """Make a string."""
        self.budget.spend_text(
            sum([len(piece.text) for piece in content.pieces]), len(content.pieces)
        )
        return RubyString(content, frozen)

    def array(self, items: list[Value]) -> Value:
        """Make an array."""
        self.budget.spend_items(len(items))
        return RubyArray(items)

    def computed(self, text: str, span: Span) -> Value:
        """Make a string that the expression at `span` computed."""
        return self.string(computed_string(text, span))

    def joined(self, *parts: TracedString) -> TracedString:
        """Return the texts one behind the other, for what that costs."""
        length = sum([len(piece.text) for part in parts for piece in part.pieces])
        self.budget.spend_text(length, sum([len(part.pieces) for part in parts]))
        return join_strings(parts)

    def traced(self, value: Value, span: Span) -> TracedString:
        """Return a string's pieces; those without origin get `span`.

        Raises:
            Unreadable: The value is no string.
        """
        if not isinstance(value, RubyString):
            raise Unreadable(span, "needs a string here")
        self.budget.spend(len(value.content.pieces) // ITEMS_PER_STEP)
        return value.content.with_origin(span)

    def written(self, value: Value, span: Span) -> TracedString:
        """Return the pieces of `to_s` of any value, computed at `span`.

        Raises:
            Unreadable: The value has no text form.
        """
        if isinstance(value, RubyString):
            return self.traced(value, span)
        try:
            text = interpolate(value, self.budget)
        except NotWritable as error:
            raise Unreadable(span, f"writes out {error}, which is not supported") from None
        return computed_string(text, span)

    def equal(self, left: Value, right: Value, span: Span) -> bool:
        """Compare two values as `==` does.

        Raises:
            Unreadable: They are arrays or hashes.
        """
        try:
            return equal(left, right, self.budget)
        except ValueError as error:
            raise Unreadable(span, f"compares two values of the class {error}") from None

    @contextmanager
    def inside(self, scope: Scope) -> Iterator[None]:
        """Run code that sees the variables of `scope`."""
        before = getattr(self, "scope", scope)
        self.scope = scope
        try:
            yield
        finally:
            self.scope = before

    def read(self, path: str, span: Span) -> SourceText:
        """Read a file of the workspace.

        Raises:
            Unreadable: The loader does not give it, or it is too large.
        """
        source = self.sources.get(path) or self.files.read(path)
        if isinstance(source, str):
            raise Unreadable(span, f"reads {path}: {source}")
        if len(source.text) > MAX_FILE_LENGTH:
            raise Unreadable(span, f"reads {path}: longer than {MAX_FILE_LENGTH} characters")
        self.sources[path] = source
        return source

    def _parsed(self, path: str, span: Span) -> RubyNode:
        source = self.read(path, span)
        self.budget.spend_parsing(len(source.text))
        try:
            return parse_ruby(source)
        except ParsesTooSlowly:
            raise Unreadable(span, f"reads {path}, which takes too long to parse") from None

    def run_file(self, path: str, span: Span) -> None:
        """Run a Ruby file of the workspace: its definitions, and its other statements."""
        tree = self.trees.get(path)
        if tree is None:
            tree = self.trees[path] = self._parsed(path, span)
        else:
            self.sources[path] = tree.source
        self.loaded.add(path)
        with self.inside(Scope(path)):
            self.evaluate(tree)


_NAMES = {
    "class": "defines a class",
    "module": "defines a module",
    "regex": "uses a regular expression",
    "lambda": "uses a lambda",
    "self": "uses self",
    "singleton_method": "defines a method of an object",
    "instance_variable": "uses an instance variable",
    "class_variable": "uses a class variable",
    "yield": "uses yield",
    "super": "uses super",
    "case_match": "uses pattern matching",
    "rational": "uses a rational number",
    "complex": "uses a complex number",
}


def _unknown(node: RubyNode) -> str:
    if node.type == "ERROR" or node.broken:
        return "contains Ruby that the parser does not understand"
    first_line = node.text.partition("\n")[0][:60]
    return _NAMES.get(node.type, f"uses '{first_line}', which is not supported")
