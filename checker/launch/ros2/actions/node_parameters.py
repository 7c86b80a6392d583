"""Parameters of nodes: mappings, files, and values that substitutions make."""

from __future__ import annotations

from collections.abc import Iterator

from checker.launch.ros2.actions.conditions import read_conditions
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import Parameter, ParameterFile, Plain, Unread
from checker.launch.ros2.substitutions import perform
from checker.launch.ros2.values import (
    FilePath,
    Guarded,
    Made,
    Symbol,
    Unknown,
    Value,
    chosen_value,
    span_of,
)
from checker.source.text import Span

UNKNOWN = "$(unknown)"
"""Placeholder for a text that this reader cannot evaluate."""

MOVEIT = "MoveItConfigsBuilder computes the parameters"
"""Reason why some parameters of a node are unknown; they concern no other part of the robot."""

Item = Parameter | ParameterFile | Unread


def read_parameters(value: Value, context: Context, span: Span) -> Iterator[Item]:
    """Yield what the `parameters` of a node state.

    Args:
        value: A list of mappings and files.
        context: The context of the node.
        span: The node.
    """
    value = chosen_value(value)
    if isinstance(value, Unknown):
        yield Unread(value.reason, value.span)
        return
    for entry in value if isinstance(value, list | tuple) else [value]:
        context.allowance.spend()
        if isinstance(entry, Guarded) and entry.holds is False:
            continue
        yield from _entry(chosen_value(entry), context, span)


def _entry(entry: Value, context: Context, span: Span) -> Iterator[Item]:
    match entry:
        case None:
            return
        case dict():
            yield from _mapping(entry, "", context, span)
        case Unknown():
            yield Unread(entry.reason, entry.span)
        case Made(name="ParameterFile"):
            substitutes = chosen_value(entry.values.get("allow_substs", False))
            file = chosen_value(entry.values.get("param_file"))
            yield _file(file, context, entry.span, substitutes in (True, "true", "True"))
        case Made(name="Parameter", values=values) if "value" in values:
            name = perform(values.get("name"), context, entry.span)
            yield from _mapping({str(name): values["value"]}, "", context, entry.span)
        case list() | tuple() if entry and all(isinstance(item, dict) for item in entry):
            for item in entry:
                yield from _mapping(item, "", context, span)
        case Made() | str() | FilePath() | list() | tuple():
            yield _file(entry, context, span)
        case _:
            yield Unread("the parameters are not evaluated", span)


def _root(file: Value, context: Context, span: Span) -> str:
    """Return the key that a rewritten file gets above all others; empty for other files."""
    rewritten = isinstance(file, Made) and file.name == "RewrittenYaml"
    key = chosen_value(file.values.get("root_key")) if rewritten else None
    text = perform(key, context, span) if key is not None else ""
    return UNKNOWN if isinstance(text, Unknown) else str(text)


def _replacements(file: Value, context: Context) -> Iterator[tuple[str, str]]:
    """Yield what a `ReplaceString` writes in place of texts of a file, unless its condition fails.

    What it may write, and what is not known, is `UNKNOWN`.
    """
    if not isinstance(file, Made):
        return
    if file.name != "ReplaceString":
        yield from _replacements(chosen_value(file.values.get("source_file")), context)
        return
    tests = read_conditions(file, context) if file.values.get("condition") is not None else ()
    held = [test.holds for test in tests]
    replacements = chosen_value(file.values.get("replacements"))
    if False in held or not isinstance(replacements, dict):
        return
    for text, written in replacements.items():
        context.allowance.spend()
        new = perform(written, context, file.span) if all(held) else UNKNOWN
        yield str(text), UNKNOWN if isinstance(new, Unknown) else str(new)


def _file(file: Value, context: Context, span: Span, substitutes: bool = False) -> Item:
    path = perform(file, context, span)
    if isinstance(path, Unknown):
        return Unread(path.reason, path.span)
    root, replaced = _root(file, context, span), tuple(_replacements(file, context))
    return ParameterFile(str(path), substitutes, span_of(path, span), root, replaced)


def _mapping(
    entries: dict[Value, Value], prefix: str, context: Context, span: Span
) -> Iterator[Item]:
    for key, written in entries.items():
        context.allowance.spend()
        name = perform(key, context, span)
        if isinstance(name, Unknown):
            yield Unread(name.reason, name.span)
            continue
        where = span_of(name, span)
        value = chosen_value(written)
        if isinstance(value, dict):
            with context.allowance:
                yield from _mapping(value, f"{prefix}{name}.", context, where)
        elif isinstance(value, Unknown):
            yield Unread(value.reason, value.span)
            if name != "moveit":
                yield Parameter(f"{prefix}{name}", UNKNOWN, True, False, value.span)
        else:
            yield _parameter(f"{prefix}{name}", value, context, where)


def _parameter(name: str, value: Value, context: Context, span: Span) -> Parameter:
    as_text = False
    if isinstance(value, Made) and value.name == "ParameterValue":
        kind = chosen_value(value.values.get("value_type"))
        as_text = (kind.last if isinstance(kind, Symbol) else kind) == "str"
        span = value.span
        value = chosen_value(value.values.get("value"))
    substituted = _is_substitution(value)
    return Parameter(name, _plain(value, context, span), substituted, as_text, span_of(value, span))


def _is_substitution(value: Value) -> bool:
    """Return whether a value is a substitution, or a list of texts that contains one."""
    if isinstance(value, Made):
        return True
    return isinstance(value, list | tuple) and any(
        isinstance(chosen_value(item), Made) for item in value
    )


def _plain(value: Value, context: Context, span: Span) -> Plain:
    value = chosen_value(value)
    if value is None or isinstance(value, bool | int | float):
        return value
    if isinstance(value, list | tuple) and not _is_substitution(value):
        return [_plain(item, context, span) for item in value]
    text = perform(value, context, span)
    return UNKNOWN if isinstance(text, Unknown) else str(text)
