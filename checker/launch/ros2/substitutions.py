"""The texts that substitutions represent, with the defaults of arguments."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping
from math import isclose
from types import MappingProxyType

from checker.formats.xacro.files import ROOT
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import LaunchFaultKind, is_known
from checker.launch.ros2.values import (
    FilePath,
    Made,
    OpenFile,
    PlacedText,
    Unknown,
    Value,
    chosen_value,
    span_of,
)
from checker.source.text import Span

NOT_DECLARED = "is not declared"
Text = PlacedText | Unknown
_TRUTH = MappingProxyType({"true": True, "1": True, "false": False, "0": False})


def truth_of(text: str) -> bool | None:
    """Read a condition as the launch system does; None for any other text."""
    return _TRUTH.get(text.strip().lower())


def perform(  # noqa: PLR0911 - one per kind of value
    value: Value, context: Context, span: Span
) -> Text:
    """Return the text that a value represents.

    Args:
        value: A text, a substitution, or a list of them.
        context: The context in which it is performed.
        span: The place of a value that has none.
    """
    context.allowance.spend()
    value = chosen_value(value)
    match value:
        case Unknown():
            return value
        case PlacedText():
            return value
        case str():
            return PlacedText(value, span)
        case bool() | int() | float():
            return PlacedText(str(value), span)
        case FilePath():
            return PlacedText(value.text, span)
        case list() | tuple() | dict():  # of which launch takes the keys
            return _joined([*value], context, span)
        case Made(name=name):
            work = _WORKS.get(name)
            if work is not None:
                with context.allowance:
                    return work(value, context)
            return Unknown(f"a {name} is not text", value.span)
        case OpenFile():
            return Unknown("an open file is not text", span)
    return Unknown("is not text", span)


def _joined(values: list[Value], context: Context, span: Span) -> Text:
    parts = []
    for value in values:
        part = perform(value, context, span)
        if isinstance(part, Unknown):
            return part
        parts.append(part)
        context.allowance.spend_on_text(sum(map(len, parts)))
    if len(parts) == 1:
        return parts[0]
    # The place of a path that is put together is that of its last part: the file's name.
    return PlacedText("".join(parts), span_of(parts[-1], span) if parts else span)


def _value(made: Made, name: str, context: Context, default: str | None = None) -> Text:
    if name not in made.values:
        if default is not None:
            return PlacedText(default, made.span)
        return Unknown(f"{made.name} has no {name}", made.span)
    return perform(made.values[name], context, made.span)


def _plain(name: str) -> Callable[[Made, Context], Text]:
    return lambda made, context: _value(made, name, context)


def _wrapped(form: str, name: str) -> Callable[[Made, Context], Text]:
    def work(made: Made, context: Context) -> Text:
        text = _value(made, name, context)
        return (
            text if isinstance(text, Unknown) else PlacedText(form.replace("{}", text), made.span)
        )

    return work


def _configuration(made: Made, context: Context) -> Text:
    name = _value(made, "variable_name", context)
    if isinstance(name, Unknown):
        return name
    context.used.add(str(name))
    if str(name) in context.state.configurations:
        return perform(context.state.configurations[str(name)], context, made.span)
    if made.values.get("default") is not None:
        return perform(made.values["default"], context, made.span)
    if context.state.beyond or (context.after and str(name) in context.declared):
        return PlacedText(f"$(var {name})", made.span)
    if is_known(name):
        message = f"argument {str(name)!r} is used, but not declared"
        context.fault(LaunchFaultKind.UNDECLARED_ARGUMENT, made.span, message, str(name))
    return Unknown(f"argument {str(name)!r} {NOT_DECLARED}", made.span)


def _path(made: Made, context: Context) -> Text:
    parts = chosen_value(made.values.get("substitutions"))
    if not isinstance(parts, list | tuple):
        return parts if isinstance(parts, Unknown) else perform(parts, context, made.span)
    texts = []
    for part in parts:
        text = perform(part, context, made.span)
        if isinstance(text, Unknown):
            return text
        texts.append(text)
    if not texts:
        return Unknown("the path is empty", made.span)
    context.allowance.spend_on_text(sum(map(len, texts)))
    return PlacedText(posixpath.join(*map(str, texts)), span_of(texts[-1], made.span))


def _share(made: Made, context: Context) -> Text:
    package = _value(made, "package", context)
    if isinstance(package, Unknown):
        return package
    if not is_known(package):
        return Unknown("the name of the package is not known", made.span)
    return PlacedText(f"{ROOT}/{package}", made.span)


def _command(made: Made, context: Context) -> Text:
    text = _value(made, "command", context)
    return text if isinstance(text, Unknown) else PlacedText(f"$(command {text})", made.span)


def _program(made: Made, context: Context) -> Text:
    executable = _value(made, "executable", context)
    package = _value(made, "package", context)
    for part in (executable, package):
        if isinstance(part, Unknown):
            return part
    return PlacedText(f"$(exec-in-pkg {executable} {package})", made.span)


def _expression(made: Made, context: Context) -> Text:
    text = _value(made, "expression", context)
    if isinstance(text, Unknown):
        return text
    if not is_known(text):
        return PlacedText(f"$(eval {text})", made.span)
    result = chosen_value(context.evaluate(str(text), made.span))
    if isinstance(result, str | bool | int | float | list | tuple):
        return PlacedText(str(result), made.span)
    reason = result.reason if isinstance(result, Unknown) else "has no value"
    return Unknown(f"the expression {str(text)[:60]!r}: {reason}", made.span)


def _environment(made: Made, context: Context) -> Text:
    name = _value(made, "name", context)
    if isinstance(name, Unknown):
        return name
    if str(name) in context.state.environment:
        return perform(context.state.environment[str(name)], context, made.span)
    if made.values.get("default_value") is not None:
        return perform(made.values["default_value"], context, made.span)
    return PlacedText(f"$(env {name})", made.span)


def _this_file(made: Made, context: Context) -> Text:
    return PlacedText(context.path, made.span)


def _this_folder(made: Made, context: Context) -> Text:
    return PlacedText(posixpath.dirname(context.path), made.span)


def _strings(made: Made, context: Context) -> Text:
    delimiter = _value(made, "delimiter", context, "")
    parts = chosen_value(made.values.get("substitutions"))
    if isinstance(delimiter, Unknown) or not isinstance(parts, list | tuple):
        return Unknown("the joined text is not known", made.span)
    texts = []
    for part in parts:
        text = perform(part, context, made.span)
        if isinstance(text, Unknown):
            return text
        texts.append(text)
    context.allowance.spend_on_text(sum(map(len, texts)) + len(texts) * len(delimiter))
    return PlacedText(str(delimiter).join(map(str, texts)), made.span)


# Truth values.


def _either(made: Made, context: Context) -> Text:
    condition = _truth(made.values.get("condition"), context, made.span)
    if isinstance(condition, Unknown):
        return condition
    return _value(made, "if_value" if condition else "else_value", context, "")


def _truth(value: Value, context: Context, span: Span) -> bool | Unknown:
    text = perform(value, context, span)
    if isinstance(text, Unknown):
        return text
    truth = truth_of(text) if is_known(text) else None
    return (
        Unknown(f"the truth of {str(text)[:60]!r} is not known", span) if truth is None else truth
    )


def _compared(*, equal: bool) -> Callable[[Made, Context], Text]:
    def work(made: Made, context: Context) -> Text:
        left, right = _value(made, "left", context), _value(made, "right", context)
        for side in (left, right):
            if isinstance(side, Unknown):
                return side
            if not is_known(side):
                return Unknown(f"{str(side)[:60]!r} is not known before the launch", made.span)
        return _truth_text(made, _same(str(left), str(right)) is equal)

    return work


def _same(left: str, right: str) -> bool:
    """Compare as the launch system does: truth values and numbers by value."""
    if left == right or {left.lower(), right.lower()} in ({"true"}, {"false"}):
        return True
    try:
        return isclose(float(left), float(right))
    except ValueError:
        return False


def _combined(*, every: bool) -> Callable[[Made, Context], Text]:
    def work(made: Made, context: Context) -> Text:
        operands = made.rest or (made.values.get("left"), made.values.get("right"))
        truths = [_truth(operand, context, made.span) for operand in operands]
        unknown = next((truth for truth in truths if isinstance(truth, Unknown)), None)
        if (not every) in [truth for truth in truths if isinstance(truth, bool)]:
            return _truth_text(made, not every)
        return unknown if unknown is not None else _truth_text(made, every)

    return work


def _not(made: Made, context: Context) -> Text:
    truth = _truth(made.values.get("value"), context, made.span)
    return truth if isinstance(truth, Unknown) else _truth_text(made, not truth)


def _boolean(made: Made, context: Context) -> Text:
    truth = _truth(made.values.get("value"), context, made.span)
    return truth if isinstance(truth, Unknown) else _truth_text(made, truth)


def _truth_text(made: Made, truth: bool) -> PlacedText:
    return PlacedText(str(truth).lower(), made.span)


_WORKS: Mapping[str, Callable[[Made, Context], Text]] = MappingProxyType(
    {
        "TextSubstitution": _plain("text"),
        "LaunchConfiguration": _configuration,
        "PathJoinSubstitution": _path,
        "PathSubstitution": _plain("path"),
        "FindPackageShare": _share,
        "FindPackagePrefix": _wrapped("$(find-pkg-prefix {})", "package"),
        "FindPackage": _wrapped("$(find-pkg-prefix {})", "package"),
        # The program is known by its name, wherever it is found.
        "FindExecutable": _plain("name"),
        "ExecutableInPackage": _program,
        "Command": _command,
        "PythonExpression": _expression,
        "EnvironmentVariable": _environment,
        "AnonName": _wrapped("$(anon {})", "name"),
        "ThisLaunchFile": _this_file,
        "ThisLaunchFileDir": _this_folder,
        "LaunchLogDir": lambda made, _: PlacedText("$(launch_log_dir)", made.span),
        "LocalSubstitution": _wrapped("$(local {})", "expression"),
        "FileContent": _wrapped("$(file-content {})", "path"),
        "StringJoinSubstitution": _strings,
        "IfElseSubstitution": _either,
        "EqualsSubstitution": _compared(equal=True),
        "NotEqualsSubstitution": _compared(equal=False),
        "AndSubstitution": _combined(every=True),
        "OrSubstitution": _combined(every=False),
        "AllSubstitution": _combined(every=True),
        "AnySubstitution": _combined(every=False),
        "NotSubstitution": _not,
        "BooleanSubstitution": _boolean,
        "Parameter": _wrapped("$(param {})", "name"),
        # Copies of the file with some values changed: their own path is of no matter.
        "RewrittenYaml": _plain("source_file"),
        "ReplaceString": _plain("source_file"),
    }
)
