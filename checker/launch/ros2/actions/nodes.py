"""Actions that start something: nodes, components and commands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.words import Suggestions
from checker.launch.ros2.actions import flow
from checker.launch.ros2.actions.commands import (
    Words,
    commands_of,
    launched_file,
    run_node,
    same_node,
)
from checker.launch.ros2.actions.conditions import read_conditions
from checker.launch.ros2.actions.node_parameters import MOVEIT
from checker.launch.ros2.actions.parts import (
    namespace_of,
    parameters_of,
    remaps_of,
    text_of,
    texts_of,
    words_of,
)
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import (
    LaunchFaultKind,
    Node,
    NodeKind,
    ParameterFile,
    Parameters,
    Process,
    Unread,
)
from checker.launch.ros2.values import (
    Guarded,
    Made,
    PlacedText,
    Unknown,
    Value,
    chosen_value,
    span_of,
)
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.launch.ros2.actions.visitor import Visitor

_ROS = "--ros-args"
OLD_KEYWORDS: Mapping[str, str] = MappingProxyType(
    {
        "node_name": "name",
        "node_executable": "executable",
        "node_namespace": "namespace",
        "node_plugin": "plugin",
    }
)
"""Keywords of nodes and components until Foxy, each with its present one."""
_REQUIRED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "Node": ("executable",),
        "LifecycleNode": ("executable", "name", "namespace"),
        # Containers have a usual program in newer releases.
        "ComposableNodeContainer": ("name", "namespace"),
        "ComposableNode": ("package", "plugin"),
    }
)
"""Keywords without which launch_ros raises a TypeError, from Galactic on."""
_KEYWORDS = (
    *("package", "executable", "name", "namespace", "exec_name", "parameters", "remappings"),
    *("ros_arguments", "arguments", "composable_node_descriptions", "condition"),
    *("plugin", "extra_arguments"),
    *("cmd", "prefix", "cwd", "env", "additional_env", "shell", "sigterm_timeout"),
    *("sigkill_timeout", "emulate_tty", "output", "output_format", "cached_output", "log_cmd"),
    *("on_exit", "respawn", "respawn_delay", "respawn_max_retries"),
)
"""Keywords of nodes and components, with those of `ExecuteProcess`, which gets the others."""
_NODES: Mapping[str, NodeKind] = MappingProxyType(
    {
        "Node": NodeKind.NODE,
        "LifecycleNode": NodeKind.LIFECYCLE,
        "ComposableNodeContainer": NodeKind.CONTAINER,
    }
)


def node(visitor: Visitor, made: Made, context: Context) -> None:
    """Gather a node or container."""
    parameters, unread = _parameters(made, context)
    arguments = [*words_of(made.values.get("arguments"), context, made.span, unread)]
    rest = words_of(made.values.get("ros_arguments"), context, made.span, unread)
    arguments += [Located(_ROS, made.span, stated=False)] if (ros := [*rest]) else []
    words, files = _files_of_words([*arguments, *ros])
    remaps = remaps_of(made, context, unread)
    name = made.values.get("name")
    environment = chosen_value(made.values.get("additional_env"))
    components = tuple(_components(made, context, unread))
    _gather(
        visitor,
        Node(
            kind=_NODES[made.name],
            package=text_of(made, "package", context, unread),
            executable=text_of(made, "executable", context, unread),
            name=text_of(made, "name", context, unread) if name is not None else None,
            namespace=namespace_of(made, context),
            arguments=tuple(words),
            parameters=(*files, *context.state.parameters, *parameters),
            remaps=remaps,
            environment=texts_of(environment, context, made.span),
            unread=tuple(unread),
            conditions=context.conditions,
            after=context.after,
            exit_of=context.exit_of,
            span=made.span,
        ),
        *components,
    )
    _keywords(made, context)
    visitor.later_events(made, context, ending=made.span)


def _files_of_words(words: Words) -> tuple[Words, list[ParameterFile]]:
    """Return the words of a command line without the parameter files, and these.

    They stand behind `--ros-args`, and before what launch writes there of the node's parameters.
    """
    values = [word.value for word in words]
    start = values.index(_ROS) if _ROS in values else len(values)
    places = [it for it in range(start, len(values) - 1) if values[it] == "--params-file"]
    files = [ParameterFile(values[it + 1], False, words[it + 1].span) for it in places]
    taken = {at for place in places for at in (place, place + 1)}
    return [word for at, word in enumerate(words) if at not in taken], files


def load(visitor: Visitor, made: Made, context: Context) -> None:
    """Gather components that are loaded into a container which something else starts."""
    unread: list[Unread] = []
    _gather(visitor, *_components(made, context, unread))
    visitor.found.unread += unread


def process(visitor: Visitor, made: Made, context: Context) -> None:
    """Gather a command."""
    unread: list[Unread] = []
    words = tuple(words_of(made.values.get("cmd"), context, made.span, unread))
    action = Process(
        words=words,
        conditions=context.conditions,
        after=context.after,
        exit_of=context.exit_of,
        span=made.span,
    )
    as_line = made.values.get("shell") in (True, "true")
    others = tuple(
        command
        for command in commands_of(words, as_line=as_line)
        if not _start(visitor, command, action, context.apart())
    )
    if others:
        spawns = tuple(filter(None, (same_node(command, action) for command in others)))
        visitor.found.processes.append(replace(action, commands=others, spawns=spawns))
    visitor.found.unread += unread
    visitor.later_events(made, context, ending=made.span)


def _start(visitor: Visitor, words: Words, process: Process, context: Context) -> bool:
    """Gather what a command starts as an action does, and return whether it does so."""
    if (ran := run_node(words, process)) is not None:
        node(visitor, ran, context)
        return True
    found, arguments = launched_file(words)
    if not found:
        return False
    *package, file = found
    path = visitor.files.launch_file(package[0].value, file.value) if package else file.value
    source = PlacedText(path, file.span)
    values = {"launch_description_source": source, "launch_arguments": arguments}
    launched = Made("IncludeLaunchDescription", values, process.span)
    flow.include(visitor, launched, context, commanded=True)
    return True


def bridge(visitor: Visitor, made: Made, context: Context) -> None:
    """Gather the node that a special action starts."""
    package, executable, file = (
        ("ros_gz_bridge", "bridge_node", "config_file")
        if made.name == "RosGzBridge"
        else ("ros_gz_sim", "gzserver", "world_sdf_file")
    )
    parameters: list[Value] = [{file: made.values[file]}] if file in made.values else []
    if "bridge_params" in made.values:
        parameters.append(Unknown("the bridge gets its parameters from a string", made.span))
    values: dict[str, Value] = {
        "package": package,
        "executable": executable,
        "name": made.values.get("bridge_name"),
        "namespace": made.values.get("namespace"),
        "parameters": parameters,
    }
    node(visitor, Made("Node", values, made.span), context)


def component_node(visitor: Visitor, made: Made, _: Context) -> None:
    """Note a component that is where an action is expected."""
    visitor.unread("a ComposableNode is not an action of its own", made.span)


def _components(made: Made, context: Context, unread: list[Unread]) -> Iterator[Node]:
    value = chosen_value(made.values.get("composable_node_descriptions"))
    if isinstance(value, Unknown):
        unread.append(Unread(value.reason, value.span))
    for given in value if isinstance(value, list | tuple) else ():
        guards = given.conditions if isinstance(given, Guarded) else ()
        item = chosen_value(given.value if isinstance(given, Guarded) else given)
        if not isinstance(item, Made):
            reason = item.reason if isinstance(item, Unknown) else "it is not a component"
            unread.append(Unread(reason, span_of(item, made.span)))
            continue
        yield _component(item, context.under(guards))


def _component(made: Made, context: Context) -> Node:
    if made.values.get("condition") is not None:
        context = context.under(read_conditions(made, context))
    _keywords(made, context)
    parameters, unread = _parameters(made, context)
    return Node(
        kind=NodeKind.COMPONENT,
        package=text_of(made, "package", context, unread),
        executable=text_of(made, "plugin", context, unread),
        name=text_of(made, "name", context, unread) if made.values.get("name") else None,
        namespace=namespace_of(made, context),
        parameters=(*context.state.parameters, *parameters),
        remaps=remaps_of(made, context, unread),
        unread=tuple(unread),
        conditions=context.conditions,
        after=context.after,
        exit_of=context.exit_of,
        span=made.span,
    )


def _gather(visitor: Visitor, *nodes: Node) -> None:
    visitor.found.nodes += nodes
    for node in nodes:
        visitor.found.unread += (
            replace(unread, by_default=node.starts is not False)
            for unread in node.unread
            if unread.reason != MOVEIT
        )


def _parameters(made: Made, context: Context) -> tuple[Parameters, list[Unread]]:
    unread: list[Unread] = []
    value = made.values.get("parameters")
    return parameters_of(value, context, made.span, unread), unread


def meant_keyword(name: str) -> str | None:
    """Return the keyword of a node for which an unknown one stands, an old or a misspelt one."""
    if name in _KEYWORDS:
        return None
    return OLD_KEYWORDS.get(name) or Suggestions(_KEYWORDS).correction(name)


def _keywords(made: Made, context: Context) -> None:
    for name in filter(meant_keyword, made.values):
        where = made.keywords.get(name, made.span)
        message = f"{made.name} has no keyword {name!r}"
        context.fault(LaunchFaultKind.ATTRIBUTE, where, message, name)
    stated = {OLD_KEYWORDS.get(name, name) for name in made.values}
    for name in _REQUIRED.get(made.name, ()):
        if name not in stated:
            context.fault(LaunchFaultKind.ATTRIBUTE, made.span, f"{made.name} has no {name}", name)
