"""Conditions, loops, jumps, errors, and the bodies that contain statements."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.launch.spawner.evaluator.expressions import elements
from checker.launch.spawner.evaluator.interpreter import Handler, Interpreter
from checker.launch.spawner.evaluator.variables import assign, define_untaken
from checker.launch.spawner.methods.enumerable import items_of
from checker.launch.spawner.scope import Function, parameters_of
from checker.launch.spawner.signals import (
    Broken,
    Continued,
    Returned,
    RubyError,
    Unreadable,
)
from checker.launch.spawner.values import (
    Constant,
    ErrorValue,
    RubyRange,
    Symbol,
    Value,
    class_name,
    truthy,
)
from checker.source.ruby import RubyNode
from checker.source.text import Span

_CLAUSES = frozenset({"rescue", "else", "ensure"})


def _statements(run: Interpreter, node: RubyNode) -> Value:
    return run.run(node.parts)


def _body(run: Interpreter, node: RubyNode) -> Value:
    """Evaluate statements with their `rescue` and `else`."""
    clauses = [part for part in node.parts if part.type in _CLAUSES]
    if any(clause.type == "ensure" for clause in clauses):
        raise Unreadable(clauses[-1].span, "uses ensure, which is not supported")
    try:
        result = run.run(part for part in node.parts if part.type not in _CLAUSES)
    except RubyError as error:
        for clause in clauses:
            if clause.type == "rescue" and _catches(run, clause, error):
                define_untaken(run, node)
                return _rescue(run, clause, error)
        raise
    for clause in clauses:
        if clause.type == "else":
            return run.evaluate(clause)
    return result


def _catches(run: Interpreter, clause: RubyNode, error: RubyError) -> bool:
    exceptions = clause.fields.get("exceptions")
    if exceptions is None:
        return error.is_a("StandardError")
    classes = elements(run, exceptions.parts)
    return any(isinstance(c, Constant) and error.is_a(c.name) for c in classes)


def _rescue(run: Interpreter, clause: RubyNode, error: RubyError) -> Value:
    variable, body = clause.fields.get("variable"), clause.fields.get("body")
    if variable is not None:
        assign(run, variable.parts[0], ErrorValue(error.kind, error.message))
    return run.evaluate(body) if body else None


def _if(run: Interpreter, node: RubyNode) -> Value:
    """Take one of two ways."""
    condition = run.evaluate(node.fields["condition"])
    ways = [node.fields.get("consequence") or node.fields.get("body")]
    ways.append(node.fields.get("alternative"))
    if truthy(condition) is node.type.startswith("unless"):
        ways.reverse()
    result = run.evaluate(ways[0]) if ways[0] else None
    if ways[1]:
        define_untaken(run, ways[1])
    return result


def _case(run: Interpreter, node: RubyNode) -> Value:
    subject = node.fields.get("value")
    value = run.evaluate(subject) if subject else None
    clauses = [part for part in node.parts if part.type in {"when", "else"}]
    taken = None
    for clause in clauses:
        if clause.type == "else":
            taken = clause
            break
        patterns = elements(run, [p.parts[0] for p in clause.parts if p.type == "pattern"])
        if any(
            _matches(run, pattern, value, clause) if subject else truthy(pattern)
            for pattern in patterns
        ):
            taken = clause.fields.get("body")
            break
    result = run.evaluate(taken) if taken else None
    for clause in clauses:
        define_untaken(run, clause)
    return result


def _matches(run: Interpreter, pattern: Value, value: Value, node: RubyNode) -> bool:
    """Compare as `pattern === value` does."""
    if isinstance(pattern, (RubyRange, Constant)):
        raise Unreadable(node.span, f"compares with a {class_name(pattern)} in a case")
    return run.equal(pattern, value, node.span)


def _while(run: Interpreter, node: RubyNode) -> Value:
    return _loop(run, node.fields["body"], _conditions(run, node), None)


def _conditions(run: Interpreter, node: RubyNode) -> Iterator[None]:
    while truthy(run.evaluate(node.fields["condition"])) is (node.type == "while"):
        yield


def _for(run: Interpreter, node: RubyNode) -> Value:
    collection = run.evaluate(node.fields["value"].parts[0])
    return _loop(run, node.fields["body"], _assignments(run, node, collection), collection)


def _assignments(run: Interpreter, node: RubyNode, collection: Value) -> Iterator[None]:
    for item in items_of(run, collection, node):
        assign(run, node.fields["pattern"], item)
        yield


def _loop(run: Interpreter, body: RubyNode, rounds: Iterator[None], result: Value) -> Value:
    """Run the body of a loop once for each round."""
    scope, entered = run.scope, False
    try:
        for _ in rounds:
            entered = True
            run.budget.spend()
            _round(run, body)
    except Broken as jump:
        if jump.scope is not scope:
            raise
        return jump.value
    if not entered:
        define_untaken(run, body)
    return result


def _round(run: Interpreter, body: RubyNode) -> None:
    scope = run.scope
    try:
        run.evaluate(body)
    except Continued as jump:
        if jump.scope is not scope:
            raise


def _argument(run: Interpreter, node: RubyNode) -> Value:
    """Return what a jump carries: nothing, one value, or an array of several."""
    values = elements(run, [value for part in node.parts for value in part.parts])
    if not values:
        return None
    return values[0] if len(values) == 1 else run.array(values)


def _return(run: Interpreter, node: RubyNode) -> Value:
    raise Returned(run.scope.call, _argument(run, node))


def _break(run: Interpreter, node: RubyNode) -> Value:
    raise Broken(run.scope, run.scope.running, _argument(run, node))


def _next(run: Interpreter, node: RubyNode) -> Value:
    raise Continued(run.scope, _argument(run, node))


def function_of(node: RubyNode, path: str) -> Function:
    """Read a definition without running it."""
    name, parameters = node.fields["name"], node.fields.get("parameters")
    end = (parameters or name).end
    span = Span(node.source, node.start, end)
    return Function(name.text, parameters_of(parameters), span, node, path)


def _define(run: Interpreter, node: RubyNode) -> Value:
    function = function_of(node, run.scope.path)
    run.functions[function.name] = function
    return Symbol(function.name)


_HOLD_STATEMENTS = ("program", "then", "do", "else", "parenthesized_statements")
_HOLD_CLAUSES = ("body_statement", "block_body", "begin")
_CHOOSE = ("if", "elsif", "conditional", "unless", "if_modifier", "unless_modifier")

STATEMENTS: Mapping[str, Handler] = {
    **dict.fromkeys(_HOLD_STATEMENTS, _statements),
    **dict.fromkeys(_HOLD_CLAUSES, _body),
    **dict.fromkeys(_CHOOSE, _if),
    "case": _case,
    "while": _while,
    "until": _while,
    "for": _for,
    "return": _return,
    "break": _break,
    "next": _next,
    "method": _define,
}
