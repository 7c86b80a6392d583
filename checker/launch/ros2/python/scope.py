"""Names that a launch file in Python binds, and the functions that it defines."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field

from checker.launch.ros2.values import Choice, Guarded, Value
from checker.source.text import SourceText


@dataclass(eq=False)
class Scope:
    """Names of a module, a function or a comprehension.

    Attributes:
        values: The values by name.
        outer: The scope in which other names are looked up.
        by_argument: Names whose values depend on arguments or files, with their defaults.
        shared: Names that `global` or `nonlocal` bind outside.
        returned: What has been returned under conditions, in a function.
        guards: The number of conditions around the call of the function.
        yielded: What a generator has yielded; None in other functions.
    """

    values: dict[str, Value] = field(default_factory=dict)
    outer: Scope | None = None
    by_argument: set[str] = field(default_factory=set)
    shared: set[str] = field(default_factory=set)
    returned: list[Guarded] = field(default_factory=list)
    guards: int = 0
    yielded: list[Value] | None = None

    def holder(self, name: str) -> Scope | None:
        """Return the scope that binds a name."""
        scope: Scope | None = self
        while scope is not None and name not in scope.values:
            scope = scope.outer
        return scope

    def bind(self, name: str, value: Value, *, by_argument: bool) -> None:
        """Bind a name."""
        scope = self
        if name in self.shared and self.outer is not None:
            scope = self.outer.holder(name) or self.outer
        scope.values[name] = value
        if by_argument:
            scope.by_argument.add(name)
        else:
            scope.by_argument.discard(name)


@dataclass(eq=False)
class LocalFunction:
    """A function or lambda of a launch file.

    Attributes:
        node: Its definition.
        scope: The scope around it.
        source: The file.
        defaults: The defaults of its last positional parameters.
        named_defaults: The defaults of its keyword-only parameters.
    """

    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
    scope: Scope
    source: SourceText
    defaults: list[Value]
    named_defaults: dict[str, Value]


@dataclass(eq=False)
class Method:
    """A method of a value, before it is called."""

    owner: Value
    name: str


@dataclass(eq=False)
class Partial:
    """A function with arguments that are given before it is called."""

    function: Value
    positional: list[Value]
    named: dict[str, Value]


def merge_names(before: dict[str, Value], first: Guarded, second: Guarded) -> dict[str, Value]:
    """Return the names after a test that could not be decided.

    Args:
        before: The names before it.
        first: The names after its body.
        second: The names after its `else`.
    """
    merged_values: dict[str, Value] = {}
    for name in {**before, **first.value, **second.value}:
        alternatives = [
            Guarded(branch.value[name], branch.conditions)
            for branch in (first, second)
            if name in branch.value
        ]
        same = len(alternatives) == 2 and alternatives[0].value is alternatives[1].value
        merged_values[name] = alternatives[0].value if same else Choice(tuple(alternatives))
    return merged_values
