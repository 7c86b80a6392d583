"""Launch files in Python: what `generate_launch_description` returns."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from checker.launch.ros2.actions.gathered import Gathered
from checker.launch.ros2.graph import LaunchFault, LaunchFaultKind
from checker.launch.ros2.python.expressions import evaluate
from checker.launch.ros2.python.interpreter import Interpreter, World
from checker.launch.ros2.python.misplaced_imports import misplaced_imports
from checker.launch.ros2.python.scope import LocalFunction, Partial, Scope
from checker.launch.ros2.python.undefined import undefined_names
from checker.launch.ros2.values import Allowance, Made, Unknown, Value, chosen_value
from checker.package.package import Package
from checker.source.text import SourceText, Span

ENTRY = "generate_launch_description"
LENGTH_LIMIT = 300_000
"""Characters of a launch file."""
EXPRESSION_LIMIT = 2_000
"""Characters of a `PythonExpression`."""


def parse_source(source: SourceText) -> ast.Module | str:
    """Return the syntax tree of a file, or why there is none."""
    if len(source.text) > LENGTH_LIMIT:
        return f"is longer than {LENGTH_LIMIT} characters"
    try:
        tree = ast.parse(source.text)
    except SyntaxError as error:
        return f"line {error.lineno}: {error.msg}"
    except (ValueError, RecursionError, MemoryError):
        return "it is nested too deeply, or contains characters that are not allowed"
    return next(_repeated_keywords(tree), tree)


def _repeated_keywords(tree: ast.Module) -> Iterator[str]:
    """Yield keywords that a call gets twice, which Python refuses after it has parsed the file."""
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        seen: set[str] = set()
        for keyword in call.keywords:
            if keyword.arg in seen:
                yield f"line {keyword.lineno}: keyword argument repeated: {keyword.arg}"
            seen |= {keyword.arg} if keyword.arg else set()


def read_python(source: SourceText, allowance: Allowance, world: World, found: Gathered) -> Value:
    """Return the launch description of a file."""
    tree = parse_source(source)
    if isinstance(tree, str) and "f-string" in tree:
        # Newer releases of Python read f-strings that this one does not.
        return Unknown(f"the file is not read: {tree}", source.whole())
    if isinstance(tree, str):
        message = f"Python cannot read the launch file: {tree}"
        found.faults.append(LaunchFault(LaunchFaultKind.SYNTAX, _line(source, tree), message))
        return Unknown(message, source.whole())
    run = Interpreter(source, allowance, world)
    for name in undefined_names(tree, ENTRY):
        message = f"name {name.use.id!r} is not defined; define or import it"
        if name.bound_in_line:
            message = (
                f"{name.use.id!r} is used before it is assigned in line {name.bound_in_line}: "
                "move the assignment above"
            )
        span = run.span(name.use)
        found.faults.append(LaunchFault(LaunchFaultKind.UNDEFINED_NAME, span, message))
    for wrong in misplaced_imports(tree):
        its = wrong.node.name
        message = f"{wrong.module} has no {its}: write from {wrong.home} import {its}"
        span = run.span(wrong.node)
        found.faults.append(LaunchFault(LaunchFaultKind.UNDEFINED_NAME, span, message))
    scope = run.module_scope(tree)
    function = scope.values.get(ENTRY)
    if not isinstance(function, LocalFunction):
        if function is None:
            message = f"the file has no function {ENTRY}(), which ros2 launch calls"
            found.faults.append(
                LaunchFault(LaunchFaultKind.NO_DESCRIPTION, source.whole(), message)
            )
        return Unknown(f"{ENTRY}() is not read", source.whole())
    value = run.called(function, [], {}, function.node)
    _tell(run, found)
    return value


def _line(source: SourceText, reason: str) -> Span:
    """Return the line of a syntax error."""
    number = reason.removeprefix("line ").partition(":")[0]
    start = source.offset_of(int(number), 1) if number.isdigit() else None
    return source.whole() if start is None else Span(source, start, start)


def _tell(run: Interpreter, found: Gathered) -> None:
    found.faults += run.faults.values()
    found.unread += run.notes


def function_call(
    function: Value,
    positional: Sequence[Value],
    allowance: Allowance,
    world: World,
    found: Gathered,
) -> Value:
    """Return what a function returns that the launch system calls: also of an `OpaqueFunction`."""
    named: dict[str, Value] = {}
    span = None
    if isinstance(function, Made):
        given = chosen_value(function.values.get("kwargs"))
        named = {str(k): v for k, v in given.items()} if isinstance(given, dict) else {}
        span = function.span
        function = chosen_value(function.values.get("function"))
    inner = function
    while isinstance(inner, Partial):
        inner = inner.function
    if not isinstance(inner, LocalFunction):
        where = span or _span_of_unknown(function)
        reason = function.reason if isinstance(function, Unknown) else "the function is not known"
        return Unknown(reason, where) if where is not None else None
    run = Interpreter(inner.source, allowance, world)
    arguments = [*positional]
    if isinstance(inner.node, ast.Lambda) or span is None:
        # An event handler may take the event and the context, or neither.
        arguments = arguments[: len(inner.node.args.args)]
    value = run.called(function, arguments, named, inner.node)
    _tell(run, found)
    return value


def _span_of_unknown(value: Value) -> Span | None:
    return value.span if isinstance(value, Unknown | Made) else None


def expression(text: str, span: Span, allowance: Allowance, world: World) -> Value:
    """Evaluate a `PythonExpression`."""
    if len(text) > EXPRESSION_LIMIT:
        return Unknown(f"has more than {EXPRESSION_LIMIT} characters", span)
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return Unknown("is not an expression of Python", span)
    run = Interpreter(SourceText(span.source.file, text.strip()), allowance, world)
    value = chosen_value(evaluate(run, tree.body, Scope()))
    return Unknown(value.reason, span) if isinstance(value, Unknown) else value


def module_of(package: Package, path: str) -> SourceText | None:
    """Return the source of a Python module that a available package contains."""
    parts = path.strip(".").split(".")
    holder = package.named(parts[0])
    if holder is None or path.startswith("."):
        return None
    for name in (f"{'/'.join(parts)}.py", f"{'/'.join(parts)}/__init__.py"):
        if holder.exists(name):
            local = name if holder is package else f"../{holder.name}/{name}"
            source = package.read(local)
            return source if isinstance(source, SourceText) else None
    return None
