"""Actions with an effect on those after them: arguments, names, parameters, variables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.words import shortened
from checker.launch.ros1.graph import Remap, resolve_name
from checker.launch.ros2.actions.node_parameters import UNKNOWN
from checker.launch.ros2.actions.parts import parameters_of, text_or_unknown, with_place
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import (
    Argument,
    EnvironmentChange,
    LaunchFaultKind,
    Unread,
    is_known,
)
from checker.launch.ros2.substitutions import perform
from checker.launch.ros2.values import Made, PlacedText, Unknown, Value, chosen_value, span_of
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.launch.ros2.actions.visitor import Visitor


def declare(visitor: Visitor, made: Made, context: Context) -> None:
    """Declare an argument; its value is what was given, else its default."""
    name = perform(made.values.get("name"), context, made.span)
    if isinstance(name, Unknown):
        visitor.unread(name.reason, name.span)
        return
    given = context.state.configurations.get(str(name))
    default = made.values.get("default_value")
    value: Value = None
    if default is not None:
        value = perform(default, context, made.span)
    declared = with_place(value, made.span) if value is not None else None
    choices = chosen_value(made.values.get("choices"))
    texts = tuple(map(str, choices)) if isinstance(choices, list | tuple) else ()
    description = chosen_value(made.values.get("description"))
    visitor.found.arguments.append(
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
    _check_choice(str(name), texts, context, made.span)


def _check_choice(name: str, choices: tuple[str, ...], context: Context, span: Span) -> None:
    value = context.state.configurations[name]
    if choices and isinstance(value, str) and is_known(value) and str(value) not in choices:
        expected = shortened(", ".join(choices), 200)
        message = f"argument {name!r} is {str(value)!r}, expected one of its choices: {expected}"
        where = span_of(value, span)
        context.fault(LaunchFaultKind.UNKNOWN_CHOICE, where, message, name)


def configure(visitor: Visitor, made: Made, context: Context) -> None:
    """Set or unset an argument."""
    name = perform(made.values.get("name"), context, made.span)
    if isinstance(name, Unknown):
        visitor.unread(name.reason, name.span)
    elif made.name == "UnsetLaunchConfiguration":
        context.state.configurations.pop(str(name), None)
    else:
        value = perform(made.values.get("value"), context, made.span)
        if not context.certain and any(c.holds is False for c in context.conditions):
            return
        if not context.certain:
            value = Unknown(f"whether {name!r} is set is not known", made.span)
        context.state.configurations[str(name)] = value


def push_namespace(visitor: Visitor, made: Made, context: Context) -> None:
    """Put the nodes that follow into a namespace."""
    name = perform(made.values.get("namespace"), context, made.span)
    if isinstance(name, Unknown):
        visitor.unread(name.reason, name.span)
    elif not any(condition.holds is False for condition in context.conditions):
        text = str(name) if context.certain else UNKNOWN
        context.state.namespace = resolve_name(text, context.state.namespace)


def set_parameter(visitor: Visitor, made: Made, context: Context) -> None:
    """Set a parameter, or those of a file, for the nodes that follow."""
    unread: list[Unread] = []
    value: Value = {made.values.get("name"): made.values.get("value")}
    if made.name == "SetUseSimTime":
        value = {"use_sim_time": made.values.get("value")}
    elif made.name == "SetParametersFromFile":
        value = made.values.get("filename")
    if not any(condition.holds is False for condition in context.conditions):
        context.state.parameters += parameters_of([value], context, made.span, unread)
    visitor.found.unread += unread


def set_remap(_: Visitor, made: Made, context: Context) -> None:
    """Remap a name for the nodes that follow."""
    source = text_or_unknown(perform(made.values.get("src"), context, made.span))
    target = text_or_unknown(perform(made.values.get("dst"), context, made.span))
    if not any(condition.holds is False for condition in context.conditions):
        remap = Remap(source, target, made.span, inherited=True)
        context.state.remaps = (remap, *context.state.remaps)


def set_environment(visitor: Visitor, made: Made, context: Context) -> None:
    """Set, extend or remove an environment variable."""
    name = perform(made.values.get("name"), context, made.span)
    value: Value = PlacedText("", made.span)
    mode = {"U": "unset", "A": "append"}.get(made.name[0], "set")
    if mode != "unset":
        value = perform(made.values.get("value"), context, made.span)
        prepends = chosen_value(made.values.get("prepend")) in (True, "true", "True")
        mode = "prepend" if prepends and mode == "append" else mode
    for text in (name, value):
        if isinstance(text, Unknown):
            visitor.unread(text.reason, text.span)
    if isinstance(name, Unknown):
        return
    if mode == "set" and context.certain:
        context.state.environment[str(name)] = value
    elif mode == "unset":
        context.state.environment.pop(str(name), None)
    visitor.found.environment.append(
        EnvironmentChange(
            name=str(name),
            value=with_place(value, made.span),
            mode=mode,
            conditions=context.conditions,
            after=context.after,
            span=made.span,
        )
    )
