"""Variables, functions and the stack of calls."""

from __future__ import annotations

from dataclasses import dataclass, field

from checker.base.record import Record
from checker.launch.spawner.values import Block, Value
from checker.source.ruby import RubyNode
from checker.source.text import Span


class Parameter(Record, eq=False):
    """A parameter of a Ruby function.

    Attributes:
        name: The name as written: `_modelURI`.
        kind: `required`, `optional`, `rest`, `keyword`, `required_keyword`, or `unknown` to the
            evaluator.
        default: The expression of the default.
        span: The whole parameter.
    """

    name: str
    kind: str
    default: RubyNode | None
    span: Span


class Function(Record, eq=False):
    """A function that a spawner defines.

    Attributes:
        name: The name, such as `spawner`.
        parameters: The parameters in order.
        span: The span from `def` to its parameters' end.
        node: Its definition.
        path: Path of its file in the workspace.
    """

    name: str
    parameters: tuple[Parameter, ...]
    span: Span
    node: RubyNode
    path: str = ""

    @property
    def required(self) -> int:
        """Number of positional parameters without default."""
        return sum(parameter.kind == "required" for parameter in self.parameters)

    @property
    def most(self) -> int | None:
        """Largest number of positional arguments; None if there is no limit."""
        kinds = [parameter.kind for parameter in self.parameters]
        return None if "rest" in kinds else sum(kind in _POSITIONAL for kind in kinds)


@dataclass(eq=False, slots=True)
class Scope:
    """The variables that a piece of code sees.

    Attributes:
        path: Path of the file in the workspace, for `__FILE__`.
        variables: The variables by name.
        parent: The scope around a block.
        frame: The call that `return` leaves; the scope of the function itself.
        running: The block whose code runs here.
    """

    path: str
    variables: dict[str, Value] = field(default_factory=dict)
    parent: Scope | None = None
    frame: Scope | None = None
    running: Block | None = None

    def holder(self, name: str) -> Scope | None:
        """Return the scope, this one or one around it, that has a variable."""
        scope: Scope | None = self
        while scope is not None and name not in scope.variables:
            scope = scope.parent
        return scope

    def assign(self, name: str, value: Value) -> None:
        """Set a variable where it is known, else here."""
        (self.holder(name) or self).variables[name] = value

    @property
    def call(self) -> Scope:
        """The scope of the function that this code belongs to."""
        return self.frame or self


def parameters_of(node: RubyNode | None) -> tuple[Parameter, ...]:
    """Read the parameter list of a function or block."""
    if node is None:
        return ()
    parameters = []
    for part in node.parts:
        kind = _KINDS.get(part.type, "unknown")
        default = part.fields.get("value")
        if part.type == "keyword_parameter" and default is None:
            kind = "required_keyword"
        name = part.fields.get("name")
        text = part.text if part.type == "identifier" else name.text if name else ""
        parameters.append(Parameter(text, kind, default, part.span))
    return tuple(parameters)


_POSITIONAL = ("required", "optional")

_KINDS = {
    "identifier": "required",
    "optional_parameter": "optional",
    "splat_parameter": "rest",
    "keyword_parameter": "keyword",
}
