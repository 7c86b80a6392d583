"""State while launch actions are visited: arguments, namespace, parameters, remaps."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

from checker.launch.ros1.graph import Remap
from checker.launch.ros2.graph import Condition, LaunchFaultKind, Parameters
from checker.launch.ros2.values import Allowance, Value
from checker.source.text import SourceText, Span

Report = Callable[[LaunchFaultKind, Span, str, str], None]
Evaluate = Callable[[str, Span], Value]


@dataclass(eq=False)
class State:
    """State that actions set for those after them, until the scoped group around them ends.

    Attributes:
        configurations: Values of arguments by name.
        environment: Variables that were set, by name.
        namespace: Absolute.
        parameters: The parameters of every node that follows.
        remaps: The remaps of every node that follows; the last one counts.
        beyond: Whether a file was included that is not available: it may declare arguments.
    """

    configurations: dict[str, Value] = field(default_factory=dict)
    environment: dict[str, Value] = field(default_factory=dict)
    namespace: str = "/"
    parameters: Parameters = ()
    remaps: tuple[Remap, ...] = ()
    beyond: bool = False

    def copy(self) -> State:
        """Return the state that a scoped group begins with."""
        return replace(
            self, configurations=dict(self.configurations), environment=dict(self.environment)
        )


@dataclass(eq=False)
class Context:
    """Context of an action.

    Attributes:
        source: The launch file.
        path: The file as it is installed, see `share_path`.
        allowance: The remaining resources of the launch.
        report: Takes faults.
        evaluate: Evaluates an expression of Python.
        state: The state that applies.
        conditions: The conditions around the action.
        after: Whether an event or a timer starts it.
        exit_of: The action whose end starts it, if one does.
        used: Names of arguments that were read.
        declared: Names of arguments that were declared.
        files: Paths of the launch files around, this one last.
    """

    source: SourceText
    path: str
    allowance: Allowance
    report: Report
    evaluate: Evaluate
    state: State = field(default_factory=State)
    conditions: tuple[Condition, ...] = ()
    after: bool = False
    exit_of: Span | None = None
    used: set[str] = field(default_factory=set)
    declared: set[str] = field(default_factory=set)
    files: tuple[str, ...] = ()

    @property
    def certain(self) -> bool:
        """True if all conditions around the action hold."""
        return all(condition.holds is True for condition in self.conditions)

    def fault(self, kind: LaunchFaultKind, span: Span, message: str, name: str = "") -> None:
        """Report a fault of an action that counts."""
        if self.certain:
            self.report(kind, span, message, name)

    def under(self, conditions: Iterable[Condition]) -> Context:
        """Return the place below conditions; what is set there is valid after them, too."""
        return replace(self, conditions=(*self.conditions, *conditions))

    def inner(self) -> Context:
        """Return a place whose state is its own, as in a scoped group."""
        return replace(self, state=self.state.copy())

    def apart(self) -> Context:
        """Return the place of a process of its own, which gets nothing but the environment."""
        return replace(self, state=State(environment=dict(self.state.environment)))
