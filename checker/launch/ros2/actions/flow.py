"""Actions that lead to other actions: includes, groups, functions, events."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.launch.ros2.actions.parts import text_or_unknown, with_place
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import Include, Node
from checker.launch.ros2.known_files import known_file, nodes_of
from checker.launch.ros2.substitutions import perform
from checker.launch.ros2.values import Made, PlacedText, Unknown, chosen_value, span_of
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.launch.ros2.actions.visitor import Visitor

_DEFERRED = (
    *("on_exit", "on_start", "on_completion", "on_shutdown", "entities", "on_stdout"),
    *("on_stderr", "on_stdin", "on_complete"),
)


def description(visitor: Visitor, made: Made, context: Context) -> None:
    """Visit a launch description."""
    visitor.visit(made.values.get("initial_entities"), context)


def include(visitor: Visitor, made: Made, context: Context, *, commanded: bool = False) -> None:
    """Visit an included file; its arguments are valid after it, too, if it is included."""
    source = chosen_value(made.values.get("launch_description_source"))
    if isinstance(source, Made) and source.name == "LaunchDescriptionSource":
        visitor.visit(source.values.get("launch_description"), context)
        return
    if isinstance(source, Made) and "launch_file_path" in source.values:
        source = source.values["launch_file_path"]
    target = perform(source, context, made.span)
    arguments = _include_arguments(visitor, made, context)
    if isinstance(target, Unknown):
        visitor.unread(target.reason, target.span)
        return
    left_out = any(condition.holds is False for condition in context.conditions)
    inner = context.inner() if left_out else context
    for name, value in arguments.items():
        inner.state.configurations[name] = PlacedText(value.value, value.span)
    became = visitor.files.include(target, inner)
    accepts, nodes = became.accepts, tuple[Node, ...]()
    if became.reason:
        context.state.beyond = True
        if (known := known_file(target)) is not None:
            accepts = frozenset(known.arguments)
            nodes = tuple(nodes_of(known, inner, made.span))
            context.used |= accepts
    visitor.found.includes.append(
        Include(
            target=with_place(target, made.span),
            arguments=arguments,
            path=became.path,
            accepts=accepts,
            reason=became.reason,
            nodes=nodes,
            commanded=commanded,
            conditions=context.conditions,
            after=context.after,
            span=made.span,
        )
    )


def _include_arguments(visitor: Visitor, made: Made, context: Context) -> dict[str, Located[str]]:
    given = chosen_value(made.values.get("launch_arguments"))
    if isinstance(given, Unknown):
        visitor.unread(given.reason, given.span)
        return {}
    pairs = given.items() if isinstance(given, dict) else given or ()
    arguments: dict[str, Located[str]] = {}
    for pair in map(chosen_value, pairs):
        if not isinstance(pair, tuple | list) or len(pair) != 2:
            reason = pair.reason if isinstance(pair, Unknown) else "it is not a pair"
            visitor.unread(reason, span_of(pair, made.span))
            continue
        name = perform(pair[0], context, made.span)
        value = perform(pair[1], context, made.span)
        if isinstance(value, Unknown):
            visitor.unread(value.reason, value.span)
        if isinstance(name, Unknown):
            visitor.unread(name.reason, name.span)
        else:
            arguments[str(name)] = Located(text_or_unknown(value), span_of(name, made.span))
    return arguments


def group(visitor: Visitor, made: Made, context: Context) -> None:
    """Visit a group; what it sets ends with it, if it is scoped."""
    scoped = chosen_value(made.values.get("scoped", True)) not in (False, "false", "False")
    inner = context.inner() if scoped else context
    given = chosen_value(made.values.get("launch_configurations"))
    if isinstance(given, dict):
        for name, value in given.items():
            text = perform(value, context, made.span)
            inner.state.configurations[str(perform(name, context, made.span))] = text
    visitor.visit(made.values.get("actions"), inner)


def handler(visitor: Visitor, made: Made, context: Context) -> None:
    """Leave what an event starts for later."""
    handler = chosen_value(made.values.get("event_handler"))
    if isinstance(handler, Made):
        target = chosen_value(handler.values.get("target_action"))
        ending = target.span if isinstance(target, Made) else None
        visitor.later_events(handler, context, _DEFERRED, ending)
    elif isinstance(handler, Unknown):
        visitor.unread(handler.reason, handler.span)


def timer(visitor: Visitor, made: Made, context: Context) -> None:
    """Leave what a timer starts for later."""
    later = context.inner()
    later.after = True
    visitor.do_later(made.values.get("actions"), later)


def opaque(visitor: Visitor, made: Made, context: Context) -> None:
    """Visit what a function returns that is called when its turn comes."""
    first = Made("LaunchContext", {}, made.span)
    positional = chosen_value(made.values.get("args")) or ()
    values = [first, *positional] if isinstance(positional, list | tuple) else [first]
    visitor.visit(visitor.files.call(made, values, context), context)


def nothing(visitor: Visitor, made: Made, context: Context) -> None:
    """Pass over what starts and sets nothing."""
