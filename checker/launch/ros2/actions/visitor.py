"""Visits launch actions in order, as the launch system does, and collects the nodes they start."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType

from checker.launch.ros2.actions import flow, nodes, settings
from checker.launch.ros2.actions.conditions import read_conditions
from checker.launch.ros2.actions.gathered import Files, Gathered
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import Unread
from checker.launch.ros2.values import Choice, Guarded, Inert, Made, Unknown, Value, chosen_value
from checker.source.text import Span


class Visitor:
    """The visit of one launch file and all that it includes."""

    def __init__(self, found: Gathered, files: Files) -> None:
        """Begin with nothing."""
        self.found = found
        self.files = files
        self._later: list[tuple[Value, Context]] = []

    def visit(self, value: Value, context: Context) -> None:
        """Visit an action, or several."""
        context.allowance.spend()
        with context.allowance:
            match value:
                case None:
                    return
                case list() | tuple():
                    for item in value:
                        self.visit(item, context)
                case Guarded():
                    self.visit(value.value, context.under(value.conditions))
                case Choice():
                    self._visit_choice(value, context)
                case Unknown():
                    self.unread(value.reason, value.span)
                case Made():
                    self._visit_made(value, context)
                case _:
                    self.unread("it is not an action", context.source.whole())

    def finish(self) -> None:
        """Visit what events start."""
        while self._later:
            value, context = self._later.pop(0)
            self.visit(value, context)

    def unread(self, reason: str, span: Span) -> None:
        """Note what is unknown."""
        self.found.unread.append(Unread(reason, span))

    def do_later(self, value: Value, context: Context) -> None:
        """Leave an action for when all others are visited."""
        self._later.append((value, context))

    def later_events(
        self,
        made: Made,
        context: Context,
        names: Sequence[str] = ("on_exit",),
        ending: Span | None = None,
    ) -> None:
        """Leave what events of an action start for later.

        Args:
            made: The action, or the event handler.
            context: Its place.
            names: The arguments that hold what is started.
            ending: The action whose end is the event `on_exit`, if it is known.
        """
        for name in names:
            value = chosen_value(made.values.get(name))
            if value is None:
                continue
            later = context.inner()
            later.after, later.exit_of = True, ending if name == "on_exit" else None
            if not isinstance(value, Made | list | tuple | Unknown):
                unknown = Unknown("an event is only known when it happens", made.span)
                value = self.files.call(value, [unknown, unknown], context)
            if isinstance(value, Unknown) and name in ("on_stdout", "on_stderr", "on_stdin"):
                continue
            if isinstance(value, Inert):
                continue
            self.do_later(value, later)

    def _visit_choice(self, choice: Choice, context: Context) -> None:
        """Visit all that may be chosen; what several alternatives share is visited once."""
        common: set[int] | None = None
        for alternative in choice.values:
            made = {id(item) for item in _made_in(alternative.value)}
            common = made if common is None else common & made
        for number, alternative in enumerate(choice.values):
            for item in _made_in(alternative.value):
                if id(item) not in (common or ()):
                    self.visit(item, context.under(alternative.conditions))
                elif number == 0:
                    self.visit(item, context)

    def _visit_made(self, made: Made, context: Context) -> None:
        handler = _HANDLERS.get(made.name)
        if handler is None:
            self.unread(f"{made.name} is not evaluated", made.span)
            return
        if made.values.get("condition") is not None and made.name != "IfElseSubstitution":
            context = context.under(read_conditions(made, context))
        handler(self, made, context)
        for name in _arguments_in([*made.values.values()]):
            context.allowance.spend()
            context.used.add(name)


def _arguments_in(waiting: list[Value]) -> Iterator[str]:
    """Yield the launch arguments that values read; actions among them are visited themselves."""
    seen: set[int] = set()
    while waiting:
        value = waiting.pop()
        if id(value) in seen:
            continue
        seen.add(id(value))
        match value:
            case Made(name="LaunchConfiguration", values={"variable_name": str(name)}):
                yield name
            case Made() if value.name not in _HANDLERS or value.name in _PASSED_OVER:
                waiting += value.values.values()
            case dict():
                waiting += (*value.keys(), *value.values())
            case list() | tuple():
                waiting += value
            case Guarded():
                waiting.append(value.value)
            case Choice():
                waiting += value.values


def _made_in(value: Value) -> Iterator[Value]:
    """Yield the actions of a description or list, one by one."""
    if isinstance(value, Made) and value.name == "LaunchDescription":
        yield from _made_in(value.values.get("initial_entities"))
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _made_in(item)
    elif value is not None:
        yield value


_PASSED_OVER = (
    *("ResetLaunchConfigurations", "ResetEnvironment", "UnregisterEventHandler", "LogInfo"),
    *("EmitEvent", "Shutdown", "PushLaunchConfigurations", "PopLaunchConfigurations"),
    *("PushEnvironment", "PopEnvironment", "SetROSLogDir"),
)


_HANDLERS: Mapping[str, Callable[[Visitor, Made, Context], None]] = MappingProxyType(
    {
        "LaunchDescription": flow.description,
        "DeclareLaunchArgument": settings.declare,
        "SetLaunchConfiguration": settings.configure,
        "UnsetLaunchConfiguration": settings.configure,
        "Node": nodes.node,
        "LifecycleNode": nodes.node,
        "ComposableNodeContainer": nodes.node,
        "ComposableNode": nodes.component_node,
        "LoadComposableNodes": nodes.load,
        "ExecuteProcess": nodes.process,
        "ExecuteLocal": nodes.process,
        "IncludeLaunchDescription": flow.include,
        "GroupAction": flow.group,
        "PushRosNamespace": settings.push_namespace,
        "PushROSNamespace": settings.push_namespace,
        "SetParameter": settings.set_parameter,
        "SetParametersFromFile": settings.set_parameter,
        "SetUseSimTime": settings.set_parameter,
        "SetRemap": settings.set_remap,
        "SetEnvironmentVariable": settings.set_environment,
        "AppendEnvironmentVariable": settings.set_environment,
        "UnsetEnvironmentVariable": settings.set_environment,
        "RegisterEventHandler": flow.handler,
        "TimerAction": flow.timer,
        "RosTimer": flow.timer,
        "ROSTimer": flow.timer,
        "OpaqueFunction": flow.opaque,
        "RosGzBridge": nodes.bridge,
        "GzServer": nodes.bridge,
    }
    | dict.fromkeys(_PASSED_OVER, flow.nothing)
)
