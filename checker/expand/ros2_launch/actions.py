"""Visits launch actions in order, as the launch system does, and gathers what they start."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType

from checker.expand.launch.graph import Remap, resolve_name
from checker.expand.ros2_launch.conditions import read_conditions
from checker.expand.ros2_launch.context import Context
from checker.expand.ros2_launch.gathered import Files, Gathered
from checker.expand.ros2_launch.graph import (
    Argument,
    Component,
    EnvironmentChange,
    Include,
    LaunchFaultKind,
    LoadedComponents,
    Node,
    NodeKind,
    Parameters,
    Process,
    Unread,
    is_known,
)
from checker.expand.ros2_launch.node_parameters import MOVEIT, UNKNOWN, read_parameters
from checker.expand.ros2_launch.substitutions import perform
from checker.expand.ros2_launch.values import (
    Choice,
    Guarded,
    Made,
    PlacedText,
    Unknown,
    Value,
    chosen,
    span_of,
)
from checker.source.text import Located, Span

_DEFERRED = ("on_exit", "on_start", "on_completion", "on_shutdown", "entities", "on_stdout")
_DEFERRED_TOO = ("on_stderr", "on_stdin", "on_complete")
_OLD_KEYWORDS = frozenset({"node_name", "node_executable", "node_namespace"})
"""Of `Node` until Foxy."""
_NODES: Mapping[str, NodeKind] = MappingProxyType(
    {
        "Node": NodeKind.NODE,
        "LifecycleNode": NodeKind.LIFECYCLE,
        "ComposableNodeContainer": NodeKind.CONTAINER,
    }
)


class Visitor:
    """The visit of one launch file and all that it includes."""

    def __init__(self, found: Gathered, files: Files) -> None:
        """Begin with nothing."""
        self.found = found
        self._files = files
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
                    self.unread("it is no action", context.source.whole())

    def finish(self) -> None:
        """Visit what events start."""
        while self._later:
            value, context = self._later.pop(0)
            self.visit(value, context)

    def unread(self, reason: str, span: Span) -> None:
        """Note what cannot be told."""
        self.found.unread.append(Unread(reason, span))

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
            self.unread(f"{made.name} is no action that is read", made.span)
            return
        if made.values.get("condition") is not None and made.name != "IfElseSubstitution":
            context = context.under(read_conditions(made, context))
        handler(self, made, context)

    # Actions.

    def description(self, made: Made, context: Context) -> None:
        """Visit a launch description."""
        self.visit(made.values.get("initial_entities"), context)

    def declare(self, made: Made, context: Context) -> None:
        """Declare an argument; its value is what was given, else its default."""
        name = perform(made.values.get("name"), context, made.span)
        if isinstance(name, Unknown):
            self.unread(name.reason, name.span)
            return
        given = context.state.configurations.get(str(name))
        default = made.values.get("default_value")
        value: Value = None
        if default is not None:
            value = perform(default, context, made.span)
        declared = _located(value, made.span) if value is not None else None
        choices = chosen(made.values.get("choices"))
        texts = tuple(map(str, choices)) if isinstance(choices, list | tuple) else ()
        description = chosen(made.values.get("description"))
        self.found.arguments.append(
            Argument(
                str(name),
                declared,
                texts,
                str(description) if isinstance(description, str) else "",
                context.conditions,
                made.span,
            )
        )
        context.declared.add(str(name))
        if given is None:
            symbolic = PlacedText(f"$(var {name})", made.span)
            context.state.configurations[str(name)] = symbolic if value is None else value
        self._check_choice(str(name), texts, context, made.span)

    def _check_choice(
        self, name: str, choices: tuple[str, ...], context: Context, span: Span
    ) -> None:
        value = context.state.configurations[name]
        if choices and isinstance(value, str) and is_known(value) and str(value) not in choices:
            message = f"argument {name!r} is {str(value)!r}, which is none of its choices"
            where = span_of(value, span)
            context.fault(LaunchFaultKind.UNKNOWN_CHOICE, where, message, name)

    def configure(self, made: Made, context: Context) -> None:
        """Set or unset an argument."""
        name = perform(made.values.get("name"), context, made.span)
        if isinstance(name, Unknown):
            self.unread(name.reason, name.span)
        elif made.name == "UnsetLaunchConfiguration":
            context.state.configurations.pop(str(name), None)
        else:
            value = perform(made.values.get("value"), context, made.span)
            if not context.certain and any(c.holds is False for c in context.conditions):
                return
            if not context.certain:
                value = Unknown(f"whether {name!r} is set is not known", made.span)
            context.state.configurations[str(name)] = value

    def node(self, made: Made, context: Context) -> None:
        """Gather a node or container."""
        parameters, unread = self._parameters(made, context)
        arguments = [*self._words(made.values.get("arguments"), context, made.span, unread)]
        rest = self._words(made.values.get("ros_arguments"), context, made.span, unread)
        arguments += [Located("--ros-args", made.span, stated=False)] if (ros := [*rest]) else []
        remaps = self._remaps(made, context, unread)
        name = made.values.get("name")
        environment = chosen(made.values.get("additional_env"))
        self.found.nodes.append(
            Node(
                kind=_NODES[made.name],
                package=self._text(made, "package", context, unread),
                executable=self._text(made, "executable", context, unread),
                name=self._text(made, "name", context, unread) if name is not None else None,
                namespace=self._namespace(made, context),
                arguments=(*arguments, *ros),
                parameters=(*context.state.parameters, *parameters),
                remaps=remaps,
                components=tuple(self._components(made, context, unread)),
                environment=_texts(environment, context, made.span),
                unread=tuple(unread),
                conditions=context.conditions,
                after=context.after,
                span=made.span,
            )
        )
        self.found.unread += (item for item in unread if item.reason != MOVEIT)
        self._keywords(made, context)
        self._events(made, context)

    def _keywords(self, made: Made, context: Context) -> None:
        for name in _OLD_KEYWORDS.intersection(made.values):
            where = made.keywords.get(name, made.span)
            message = f"{made.name} takes no keyword {name!r}"
            context.fault(LaunchFaultKind.ATTRIBUTE, where, message, name)
        # Containers have a usual program in newer releases.
        stated = {"executable", "node_executable"}.intersection(made.values)
        if not stated and made.name != "ComposableNodeContainer":
            message = f"{made.name} has no executable"
            context.fault(LaunchFaultKind.ATTRIBUTE, made.span, message, "executable")

    def component_node(self, made: Made, _: Context) -> None:
        """Note a component that stands where an action is expected."""
        self.unread("a ComposableNode is no action of its own", made.span)

    def load(self, made: Made, context: Context) -> None:
        """Gather components that are loaded into a container."""
        unread: list[Unread] = []
        target = chosen(made.values.get("target_container"))
        name = UNKNOWN
        if isinstance(target, Made) and target.name == "ComposableNodeContainer":
            target = target.values.get("name")
        text = perform(target, context, made.span)
        if not isinstance(text, Unknown):
            name = resolve_name(str(text), context.state.namespace)
        components = tuple(self._components(made, context, unread))
        self.found.components.append(
            LoadedComponents(
                container=name,
                components=components,
                conditions=context.conditions,
                after=context.after,
                span=made.span,
            )
        )
        self.found.unread += unread

    def process(self, made: Made, context: Context) -> None:
        """Gather a command."""
        unread: list[Unread] = []
        words = tuple(self._words(made.values.get("cmd"), context, made.span, unread))
        self.found.processes.append(
            Process(
                words=words,
                in_shell=chosen(made.values.get("shell")) in (True, "true", "True"),
                conditions=context.conditions,
                after=context.after,
                span=made.span,
            )
        )
        self.found.unread += unread
        self._events(made, context)

    def include(self, made: Made, context: Context) -> None:
        """Visit an included file; the arguments that it is given hold behind it, too."""
        source = chosen(made.values.get("launch_description_source"))
        if isinstance(source, Made) and source.name == "LaunchDescriptionSource":
            self.visit(source.values.get("launch_description"), context)
            return
        if isinstance(source, Made) and "launch_file_path" in source.values:
            source = source.values["launch_file_path"]
        target = perform(source, context, made.span)
        arguments = self._include_arguments(made, context)
        if isinstance(target, Unknown):
            self.unread(target.reason, target.span)
            return
        for name, value in arguments.items():
            context.state.configurations[name] = PlacedText(value.value, value.span)
        became = self._files.include(target, context)
        if became.reason:
            context.state.beyond = True
        self.found.includes.append(
            Include(
                target=_located(target, made.span),
                arguments=arguments,
                path=became.path,
                accepts=became.accepts,
                reason=became.reason,
                conditions=context.conditions,
                after=context.after,
                span=made.span,
            )
        )

    def _include_arguments(self, made: Made, context: Context) -> dict[str, Located[str]]:
        given = chosen(made.values.get("launch_arguments"))
        if isinstance(given, Unknown):
            self.unread(given.reason, given.span)
            return {}
        pairs = given.items() if isinstance(given, dict) else given or ()
        arguments: dict[str, Located[str]] = {}
        for pair in map(chosen, pairs):
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                reason = pair.reason if isinstance(pair, Unknown) else "it is no pair"
                self.unread(reason, span_of(pair, made.span))
                continue
            name = perform(pair[0], context, made.span)
            value = perform(pair[1], context, made.span)
            if isinstance(value, Unknown):
                self.unread(value.reason, value.span)
            if isinstance(name, Unknown):
                self.unread(name.reason, name.span)
            else:
                arguments[str(name)] = Located(_text_or_unknown(value), span_of(name, made.span))
        return arguments

    def group(self, made: Made, context: Context) -> None:
        """Visit a group; what it sets ends with it, if it is scoped."""
        scoped = chosen(made.values.get("scoped", True)) not in (False, "false", "False")
        inner = context.inner() if scoped else context
        given = chosen(made.values.get("launch_configurations"))
        if isinstance(given, dict):
            for name, value in given.items():
                text = perform(value, context, made.span)
                inner.state.configurations[str(perform(name, context, made.span))] = text
        self.visit(made.values.get("actions"), inner)

    def push_namespace(self, made: Made, context: Context) -> None:
        """Put the nodes that follow into a namespace."""
        name = perform(made.values.get("namespace"), context, made.span)
        if isinstance(name, Unknown):
            self.unread(name.reason, name.span)
        elif not any(condition.holds is False for condition in context.conditions):
            text = str(name) if context.certain else UNKNOWN
            context.state.namespace = resolve_name(text, context.state.namespace)

    def set_parameter(self, made: Made, context: Context) -> None:
        """Set a parameter, or those of a file, for the nodes that follow."""
        unread: list[Unread] = []
        value: Value = {made.values.get("name"): made.values.get("value")}
        if made.name == "SetUseSimTime":
            value = {"use_sim_time": made.values.get("value")}
        elif made.name == "SetParametersFromFile":
            value = made.values.get("filename")
        if not any(condition.holds is False for condition in context.conditions):
            context.state.parameters += self._read_parameters([value], context, made.span, unread)
        self.found.unread += unread

    def set_remap(self, made: Made, context: Context) -> None:
        """Remap a name for the nodes that follow."""
        source = _text_or_unknown(perform(made.values.get("src"), context, made.span))
        target = _text_or_unknown(perform(made.values.get("dst"), context, made.span))
        if not any(condition.holds is False for condition in context.conditions):
            remap = Remap(source, target, made.span, inherited=True)
            context.state.remaps = (remap, *context.state.remaps)

    def set_environment(self, made: Made, context: Context) -> None:
        """Set, extend or remove an environment variable."""
        name = perform(made.values.get("name"), context, made.span)
        value: Value = PlacedText("", made.span)
        mode = {"U": "unset", "A": "append"}.get(made.name[0], "set")
        if mode != "unset":
            value = perform(made.values.get("value"), context, made.span)
            prepends = chosen(made.values.get("prepend")) in (True, "true", "True")
            mode = "prepend" if prepends and mode == "append" else mode
        for text in (name, value):
            if isinstance(text, Unknown):
                self.unread(text.reason, text.span)
        if isinstance(name, Unknown):
            return
        if mode == "set" and context.certain:
            context.state.environment[str(name)] = value
        elif mode == "unset":
            context.state.environment.pop(str(name), None)
        self.found.environment.append(
            EnvironmentChange(
                name=str(name),
                value=_located(value, made.span),
                mode=mode,
                conditions=context.conditions,
                after=context.after,
                span=made.span,
            )
        )

    def handler(self, made: Made, context: Context) -> None:
        """Leave what an event starts for later."""
        handler = chosen(made.values.get("event_handler"))
        if isinstance(handler, Made):
            self._events(handler, context, (*_DEFERRED, *_DEFERRED_TOO))
        elif isinstance(handler, Unknown):
            self.unread(handler.reason, handler.span)

    def _events(self, made: Made, context: Context, names: Sequence[str] = ("on_exit",)) -> None:
        for name in names:
            value = chosen(made.values.get(name))
            if value is None:
                continue
            later = context.inner()
            later.after = True
            if not isinstance(value, Made | list | tuple | Unknown):
                value = self._files.call(value, _event_arguments(made.span), context)
            if isinstance(value, Unknown) and name in ("on_stdout", "on_stderr", "on_stdin"):
                continue
            self._later.append((value, later))

    def timer(self, made: Made, context: Context) -> None:
        """Leave what a timer starts for later."""
        later = context.inner()
        later.after = True
        self._later.append((made.values.get("actions"), later))

    def opaque(self, made: Made, context: Context) -> None:
        """Visit what a function returns that is called when its turn comes."""
        first = Made("LaunchContext", {}, made.span)
        positional = chosen(made.values.get("args")) or ()
        values = [first, *positional] if isinstance(positional, list | tuple) else [first]
        self.visit(self._files.call(made, values, context), context)

    def bridge(self, made: Made, context: Context) -> None:
        """Gather the node that a special action starts."""
        package, executable, file = (
            ("ros_gz_bridge", "bridge_node", "config_file")
            if made.name == "RosGzBridge"
            else ("ros_gz_sim", "gzserver", "world_sdf_file")
        )
        parameters: list[Value] = [{file: made.values[file]}] if file in made.values else []
        if "bridge_params" in made.values:
            parameters.append(Unknown("the bridge is given parameters in a text", made.span))
        values: dict[str, Value] = {
            "package": package,
            "executable": executable,
            "name": made.values.get("bridge_name"),
            "namespace": made.values.get("namespace"),
            "parameters": parameters,
        }
        self.node(Made("Node", values, made.span), context)

    def nothing(self, made: Made, context: Context) -> None:
        """Pass over what starts and sets nothing."""

    # Parts of actions.

    def _text(self, made: Made, name: str, context: Context, unread: list[Unread]) -> Located[str]:
        if made.values.get(name) is None:
            return Located("", made.span, stated=False)
        text = perform(made.values[name], context, made.span)
        if isinstance(text, Unknown):
            unread.append(Unread(text.reason, text.span))
        return _located(text, made.span)

    def _namespace(self, made: Made, context: Context) -> str:
        value = made.values.get("namespace")
        text = perform(value, context, made.span) if value is not None else ""
        if isinstance(text, Unknown):
            text = UNKNOWN
        return resolve_name(str(text), context.state.namespace)

    def _words(
        self, value: Value, context: Context, span: Span, unread: list[Unread]
    ) -> Iterator[Located[str]]:
        value = chosen(value)
        if value is None:
            return
        if isinstance(value, Unknown):
            unread.append(Unread(value.reason, value.span))
            return
        for item in value if isinstance(value, list | tuple) else [value]:
            if isinstance(item, Guarded) and item.holds is False:
                continue
            text = perform(item, context, span)
            if isinstance(text, Unknown):
                unread.append(Unread(text.reason, text.span))
            yield _located(text, span)

    def _parameters(self, made: Made, context: Context) -> tuple[Parameters, list[Unread]]:
        unread: list[Unread] = []
        value = made.values.get("parameters")
        return self._read_parameters(value, context, made.span, unread), unread

    def _read_parameters(
        self, value: Value, context: Context, span: Span, unread: list[Unread]
    ) -> Parameters:
        if value is None:
            return ()
        items = [*read_parameters(value, context, span)]
        unread += (item for item in items if isinstance(item, Unread))
        return tuple(item for item in items if not isinstance(item, Unread))

    def _remaps(self, made: Made, context: Context, unread: list[Unread]) -> tuple[Remap, ...]:
        value = chosen(made.values.get("remappings"))
        if isinstance(value, Unknown):
            unread.append(Unread(value.reason, value.span))
            value = None
        own = []
        for pair in map(chosen, value if isinstance(value, list | tuple) else ()):
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                reason = pair.reason if isinstance(pair, Unknown) else "it is no pair"
                unread.append(Unread(reason, span_of(pair, made.span)))
                continue
            source, target = (perform(part, context, made.span) for part in pair)
            unread += (Unread(t.reason, t.span) for t in (source, target) if isinstance(t, Unknown))
            where = span_of(source, made.span)
            own.append(Remap(_text_or_unknown(source), _text_or_unknown(target), where))
        return (*own, *context.state.remaps)

    def _components(
        self, made: Made, context: Context, unread: list[Unread]
    ) -> Iterator[Component]:
        value = chosen(made.values.get("composable_node_descriptions"))
        if isinstance(value, Unknown):
            unread.append(Unread(value.reason, value.span))
        given = value if isinstance(value, list | tuple) else ()
        there = (v for v in given if not (isinstance(v, Guarded) and v.holds is False))
        for item in map(chosen, there):
            if not isinstance(item, Made):
                reason = item.reason if isinstance(item, Unknown) else "it is no component"
                unread.append(Unread(reason, span_of(item, made.span)))
                continue
            parameters = self._read_parameters(
                item.values.get("parameters"), context, item.span, unread
            )
            yield Component(
                self._text(item, "package", context, unread),
                self._text(item, "plugin", context, unread),
                self._text(item, "name", context, unread).value,
                self._namespace(item, context),
                (*context.state.parameters, *parameters),
                self._remaps(item, context, unread),
                item.span,
            )


def _made_in(value: Value) -> Iterator[Value]:
    """Yield the actions of a description or list, one by one."""
    if isinstance(value, Made) and value.name == "LaunchDescription":
        yield from _made_in(value.values.get("initial_entities"))
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _made_in(item)
    elif value is not None:
        yield value


def _event_arguments(span: Span) -> list[Value]:
    return [Unknown("an event is only known when it happens", span) for _ in range(2)]


def _located(value: Value, span: Span) -> Located[str]:
    return Located(_text_or_unknown(value), span_of(value, span))


def _text_or_unknown(value: Value) -> str:
    return str(value) if isinstance(value, str) else UNKNOWN


def _texts(value: Value, context: Context, span: Span) -> dict[str, str]:
    if not isinstance(value, dict):
        return {}
    return {
        _text_or_unknown(perform(name, context, span)): _text_or_unknown(
            perform(text, context, span)
        )
        for name, text in value.items()
    }


_PASSED_OVER = (
    *("ResetLaunchConfigurations", "ResetEnvironment", "UnregisterEventHandler", "LogInfo"),
    *("EmitEvent", "Shutdown", "PushLaunchConfigurations", "PopLaunchConfigurations"),
    *("PushEnvironment", "PopEnvironment", "SetROSLogDir"),
)


_HANDLERS: Mapping[str, Callable[[Visitor, Made, Context], None]] = MappingProxyType(
    {
        "LaunchDescription": Visitor.description,
        "DeclareLaunchArgument": Visitor.declare,
        "SetLaunchConfiguration": Visitor.configure,
        "UnsetLaunchConfiguration": Visitor.configure,
        "Node": Visitor.node,
        "LifecycleNode": Visitor.node,
        "ComposableNodeContainer": Visitor.node,
        "ComposableNode": Visitor.component_node,
        "LoadComposableNodes": Visitor.load,
        "ExecuteProcess": Visitor.process,
        "ExecuteLocal": Visitor.process,
        "IncludeLaunchDescription": Visitor.include,
        "GroupAction": Visitor.group,
        "PushRosNamespace": Visitor.push_namespace,
        "PushROSNamespace": Visitor.push_namespace,
        "SetParameter": Visitor.set_parameter,
        "SetParametersFromFile": Visitor.set_parameter,
        "SetUseSimTime": Visitor.set_parameter,
        "SetRemap": Visitor.set_remap,
        "SetEnvironmentVariable": Visitor.set_environment,
        "AppendEnvironmentVariable": Visitor.set_environment,
        "UnsetEnvironmentVariable": Visitor.set_environment,
        "RegisterEventHandler": Visitor.handler,
        "TimerAction": Visitor.timer,
        "RosTimer": Visitor.timer,
        "ROSTimer": Visitor.timer,
        "OpaqueFunction": Visitor.opaque,
        "RosGzBridge": Visitor.bridge,
        "GzServer": Visitor.bridge,
    }
    | dict.fromkeys(_PASSED_OVER, Visitor.nothing)
)
