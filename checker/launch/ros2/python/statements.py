"""Statements of launch files in Python; both branches are taken where a test is not decided."""

from __future__ import annotations

import ast
import enum
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from checker.launch.ros2.classes import ROOTS
from checker.launch.ros2.graph import Condition
from checker.launch.ros2.python.expressions import binary, each, evaluate, negate
from checker.launch.ros2.python.scope import Scope, merge_names
from checker.launch.ros2.values import (
    FilePath,
    Guarded,
    HandledError,
    Inert,
    OpenFile,
    Symbol,
    Unknown,
    Value,
)
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

ROUNDS_LIMIT = 2_000
"""Greatest number of rounds of a `while` loop."""


class Flow(enum.Enum):
    """Reason why the execution of a statement ends."""

    ON = "goes on"
    BREAK = "leaves the loop"
    CONTINUE = "goes on with the next round"
    RETURN = "returns"
    RAISE = "raises an error"


def run_block(run: Interpreter, body: Sequence[ast.stmt], scope: Scope) -> tuple[Flow, Value]:
    """Run statements until one ends the block; return how it ends, and what is returned."""
    guards = len(run.guards)
    try:
        for statement in body:
            run.allowance.spend()
            handler = _HANDLERS.get(type(statement))
            if handler is None:
                run.unread(
                    statement, f"a statement of type {type(statement).__name__} is not evaluated"
                )
                continue
            with run.allowance:
                flow, value = handler(run, statement, scope)
            if flow is not Flow.ON:
                return flow, value
        return Flow.ON, None
    finally:
        # An early return under a condition guards what follows it in this block.
        del run.guards[guards:]


def _expression(run: Interpreter, node: ast.Expr, scope: Scope) -> tuple[Flow, Value]:
    value = evaluate(run, node.value, scope)
    if isinstance(value, Unknown) and isinstance(node.value, ast.Call):
        run.ignored(value)
    return Flow.ON, None


def _assign(run: Interpreter, node: ast.Assign, scope: Scope) -> tuple[Flow, Value]:
    value = run.watched(node.value, scope)
    for target in node.targets:
        run.assign(target, value, scope)
    return Flow.ON, None


def _annotated(run: Interpreter, node: ast.AnnAssign, scope: Scope) -> tuple[Flow, Value]:
    if node.value is not None:
        run.assign(node.target, run.watched(node.value, scope), scope)
    return Flow.ON, None


def _augmented(run: Interpreter, node: ast.AugAssign, scope: Scope) -> tuple[Flow, Value]:
    value = run.watched(node.value, scope)
    load = ast.copy_location(_as_load(node.target), node.target)
    before = evaluate(run, load, scope)
    if isinstance(before, list) and isinstance(node.op, ast.Add):
        before += run.guarded(each(run, value, node.value))
        return Flow.ON, None
    run.assign(node.target, binary(run, node.op, before, value, node), scope)
    return Flow.ON, None


def _as_load(node: ast.expr) -> ast.expr:
    match node:
        case ast.Name(id=name):
            return ast.Name(name, ast.Load())
        case ast.Attribute(value=value, attr=attr):
            return ast.Attribute(value, attr, ast.Load())
        case ast.Subscript(value=value, slice=index):
            return ast.Subscript(value, index, ast.Load())
    return node


def _return(run: Interpreter, node: ast.Return, scope: Scope) -> tuple[Flow, Value]:
    value = evaluate(run, node.value, scope) if node.value is not None else None
    conditions = tuple(run.guards[scope.guards :])
    return Flow.RETURN, Guarded(value, conditions) if conditions else value


def _raise(*_: Any) -> tuple[Flow, Value]:
    return Flow.RAISE, None


def _pass(*_: Any) -> tuple[Flow, Value]:
    return Flow.ON, None


def _break(*_: Any) -> tuple[Flow, Value]:
    return Flow.BREAK, None


def _continue(*_: Any) -> tuple[Flow, Value]:
    return Flow.CONTINUE, None


def _if(run: Interpreter, node: ast.If, scope: Scope) -> tuple[Flow, Value]:
    run.by_argument = False
    truth, condition = run.test(node.test, scope)
    decided = truth is not None and not run.by_argument
    run.by_argument = False
    if decided:
        return run_block(run, node.body if truth else node.orelse, scope)
    return _either(run, (node.body, condition), (node.orelse, negate(condition)), scope)


Branch = tuple[Sequence[ast.stmt], Condition]


def _either(run: Interpreter, first: Branch, second: Branch, scope: Scope) -> tuple[Flow, Value]:
    """Run both branches, each as guarded by its condition, and join what they leave behind."""
    before = dict(scope.values)
    ends = []
    for body, condition in (first, second):
        scope.values = dict(before)
        run.guards.append(condition)
        flow, value = run_block(run, body, scope)
        run.guards.pop()
        ends.append((flow, value, Guarded(scope.values, (condition,))))
    for flow, value, _ in ends:
        if flow is Flow.RETURN and value is not RETURNED:
            scope.returned.append(value)
    stays = [(flow, after) for flow, _, after in ends if flow not in (Flow.RETURN, Flow.RAISE)]
    returns = any(flow is Flow.RETURN for flow, _, _ in ends)
    if not stays:
        return (Flow.RETURN, RETURNED) if returns else (Flow.RAISE, None)
    if len(stays) == 1:
        flow, after = stays[0]
        scope.values = after.value
        if returns:
            run.guards += after.conditions
        return flow, None
    scope.values = merge_names(before, stays[0][1], stays[1][1])
    return (stays[0][0] if stays[0][0] is stays[1][0] else Flow.ON), None


RETURNED = object()
"""Represents the value of a block whose branches have all returned: they are in the scope."""


def _for(run: Interpreter, node: ast.For, scope: Scope) -> tuple[Flow, Value]:
    items = each(run, evaluate(run, node.iter, scope), node.iter)
    for guarded in items:
        run.allowance.spend()
        conditions: tuple[Condition, ...] = ()
        item = guarded
        if isinstance(guarded, Guarded):
            conditions, item = guarded.conditions, guarded.value
        elif isinstance(guarded, Unknown):
            text = Located(f"for … in {ast.unparse(node.iter)[:80]}", guarded.span)
            conditions = (Condition(text, wanted=True, holds=None),)
        run.guards += conditions
        run.assign(node.target, item, scope)
        flow, value = run_block(run, node.body, scope)
        del run.guards[len(run.guards) - len(conditions) :]
        if flow in (Flow.RETURN, Flow.RAISE):
            return flow, value
        if flow is Flow.BREAK:
            return Flow.ON, None
    return run_block(run, node.orelse, scope) if node.orelse else (Flow.ON, None)


def _while(run: Interpreter, node: ast.While, scope: Scope) -> tuple[Flow, Value]:
    for _ in range(ROUNDS_LIMIT):
        truth, _ = run.test(node.test, scope)
        if truth is False:
            return Flow.ON, None
        if truth is None:
            break
        flow, value = run_block(run, node.body, scope)
        if flow in (Flow.RETURN, Flow.RAISE):
            return flow, value
        if flow is Flow.BREAK:
            return Flow.ON, None
    run.unread(node, "how often the loop runs is not known")
    return Flow.ON, None


def _with(run: Interpreter, node: ast.With, scope: Scope) -> tuple[Flow, Value]:
    for item in node.items:
        value = evaluate(run, item.context_expr, scope)
        if item.optional_vars is not None:
            run.assign(item.optional_vars, value, scope)
        elif not isinstance(value, OpenFile | FilePath | Unknown):
            run.unread(node, "the context is not evaluated")
    return run_block(run, node.body, scope)


def _try(run: Interpreter, node: ast.Try, scope: Scope) -> tuple[Flow, Value]:
    """Run the body, and the handler of an error of Python that is sure to be raised."""
    handlers = [(_handled(handler), handler.body) for handler in node.handlers]
    names = frozenset(name for own, _ in handlers for name in own)
    run.handled.append((names, len(run.guards)))
    try:
        flow, value = run_block(run, node.body, scope)
        after = node.orelse if flow is Flow.ON else []
    except HandledError as error:
        body = next((body for own, body in handlers if own & error.names), None)
        if body is None:
            run_block(run, node.finalbody, scope)
            raise
        flow, value, after = Flow.ON, None, body
    finally:
        run.handled.pop()
    if after:
        flow, value = run_block(run, after, scope)
    end, last = run_block(run, node.finalbody, scope)
    return (flow, value) if end is Flow.ON else (end, last)


def _handled(handler: ast.ExceptHandler) -> frozenset[str]:
    """Return the names of the errors that a handler is for."""
    kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = (ast.unparse(kind).rpartition(".")[2] if kind else "BaseException" for kind in kinds)
    return frozenset(names)


def _define(run: Interpreter, node: ast.FunctionDef, scope: Scope) -> tuple[Flow, Value]:
    function = run.function(node, scope)
    scope.bind(node.name, function, by_argument=False)
    return Flow.ON, None


def _class(run: Interpreter, node: ast.ClassDef, scope: Scope) -> tuple[Flow, Value]:
    names = {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}
    holders = {name: scope.holder(name) for name in names}
    used = [holder.values[name] for name, holder in holders.items() if holder is not None]
    kind = Inert if all(map(_is_plain, used)) else Unknown
    reason = f"class {node.name} is not evaluated"
    scope.bind(node.name, kind(reason, run.span(node)), by_argument=False)
    return Flow.ON, None


def _is_plain(value: Value) -> bool:
    """Return whether a value is data, or imported from outside the launch system."""
    if isinstance(value, Symbol):
        return value.root not in ROOTS
    return isinstance(value, str | int | float | FilePath)


def _import(run: Interpreter, node: ast.Import, scope: Scope) -> tuple[Flow, Value]:
    for alias in node.names:
        name = alias.asname or alias.name.partition(".")[0]
        path = alias.name if alias.asname else name
        scope.bind(name, run.imported(path, node), by_argument=False)
    return Flow.ON, None


def _import_from(run: Interpreter, node: ast.ImportFrom, scope: Scope) -> tuple[Flow, Value]:
    module = f"{'.' * node.level}{node.module or ''}"
    for alias in node.names:
        for name in run.names_of(module, node) if alias.name == "*" else (alias.name,):
            value = run.imported(f"{module}.{name}", node)
            scope.bind(alias.asname or name, value, by_argument=False)
    return Flow.ON, None


def _shared(_: Interpreter, node: ast.Global | ast.Nonlocal, scope: Scope) -> tuple[Flow, Value]:
    scope.shared.update(node.names)
    return Flow.ON, None


def _delete(_: Interpreter, node: ast.Delete, scope: Scope) -> tuple[Flow, Value]:
    for target in node.targets:
        if isinstance(target, ast.Name):
            scope.values.pop(target.id, None)
    return Flow.ON, None


_Handler = Callable[["Interpreter", Any, Scope], tuple[Flow, Value]]
_HANDLERS: Mapping[type[ast.stmt], _Handler] = {
    ast.Expr: _expression,
    ast.Assign: _assign,
    ast.AnnAssign: _annotated,
    ast.AugAssign: _augmented,
    ast.Return: _return,
    ast.Raise: _raise,
    ast.Assert: _pass,
    ast.Pass: _pass,
    ast.Break: _break,
    ast.Continue: _continue,
    ast.If: _if,
    ast.For: _for,
    ast.While: _while,
    ast.With: _with,
    ast.Try: _try,
    ast.FunctionDef: _define,
    ast.ClassDef: _class,
    ast.Import: _import,
    ast.ImportFrom: _import_from,
    ast.Global: _shared,
    ast.Nonlocal: _shared,
    ast.Delete: _delete,
}
