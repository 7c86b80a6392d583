"""Conditions, loops, jumps, errors, and the bodies that hold statements."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from checker.expand.spawner.evaluator.assignment import assign, mark_untaken
from checker.expand.spawner.evaluator.expressions import elements
from checker.expand.spawner.evaluator.interpreter import Handler, Interpreter
from checker.expand.spawner.methods.iteration import items_of
from checker.expand.spawner.ruby_errors import is_kind, rescued_by_default
from checker.expand.spawner.scope import Function, parameters_of
from checker.expand.spawner.signals import (
    Broken,
    Continued,
    Returned,
    RubyError,
    Unreadable,
)
from checker.expand.spawner.values import (
    NIL,
    Constant,
    ErrorValue,
    RubyRange,
    Symbol,
    Value,
    class_name,
    equal,
)
from checker.source.ruby import RubyNode
from checker.source.text import Span

_CLAUSES = frozenset({"rescue", "else", "ensure"})


def _program(run: Interpreter, node: RubyNode) -> Value:
    try:
        return run.run(node.parts)
    except Returned as jump:
        if jump.frame is not run.scope:
            raise
        return jump.value


def _statements(run: Interpreter, node: RubyNode) -> Value:
    return run.run(node.parts)


def _body(run: Interpreter, node: RubyNode) -> Value:
    """Evaluate statements with their `rescue`, `else` and `ensure`."""
    parts = node.parts
    clauses = [part for part in parts if part.type in _CLAUSES]
    statements = [part for part in parts if part.type not in _CLAUSES]
    if not clauses:
        return run.run(statements)
    ensure = [clause for clause in clauses if clause.type == "ensure"]
    try:
        result = _rescued(run, statements, clauses)
    except (RubyError, Returned, Broken, Continued):
        run.run(ensure)
        raise
    run.run(ensure)
    return result


def _rescued(run: Interpreter, statements: list[RubyNode], clauses: list[RubyNode]) -> Value:
    try:
        result = run.run(statements)
    except RubyError as error:
        for clause in clauses:
            if clause.type == "rescue" and _catches(run, clause, error):
                return _handle(run, clause, error)
        raise
    for clause in clauses:
        if clause.type == "else":
            return run.evaluate(clause)
    return result


def _catches(run: Interpreter, clause: RubyNode, error: RubyError) -> bool:
    exceptions = clause.fields.get("exceptions")
    if exceptions is None:
        return rescued_by_default(error.kind)
    classes = elements(run, exceptions.parts)
    return any(isinstance(c.data, Constant) and is_kind(error.kind, c.data.name) for c in classes)


def _handle(run: Interpreter, clause: RubyNode, error: RubyError) -> Value:
    variable = clause.fields.get("variable")
    if variable is not None:
        assign(run, variable.parts[0], run.value(ErrorValue(error.kind, error.message)))
    body = clause.fields.get("body")
    return run.evaluate(body) if body else NIL


def _rescue_modifier(run: Interpreter, node: RubyNode) -> Value:
    try:
        return run.evaluate(node.fields["body"])
    except RubyError as error:
        if not rescued_by_default(error.kind):
            raise
        return run.evaluate(node.fields["handler"])


def _choose(run: Interpreter, condition: Value, ways: dict[bool, RubyNode | None]) -> Value:
    """Take one of two ways; what is set on the other one depends on the condition, too."""
    taken, other = ways[condition.truthy], ways[not condition.truthy]
    with run.influenced_by(condition):
        result = run.evaluate(taken) if taken else NIL
    if other is not None:
        mark_untaken(run, other, condition.influences)
    if not condition.influences:
        return result
    return Value(result.data, result.parameters | condition.influences)


def _if(run: Interpreter, node: RubyNode) -> Value:
    then, other = node.fields.get("consequence"), node.fields.get("alternative")
    return _choose(run, run.evaluate(node.fields["condition"]), {True: then, False: other})


def _unless(run: Interpreter, node: RubyNode) -> Value:
    then, other = node.fields.get("consequence"), node.fields.get("alternative")
    return _choose(run, run.evaluate(node.fields["condition"]), {True: other, False: then})


def _if_modifier(run: Interpreter, node: RubyNode) -> Value:
    wanted = node.type == "if_modifier"
    ways: dict[bool, RubyNode | None] = {wanted: node.fields["body"], not wanted: None}
    return _choose(run, run.evaluate(node.fields["condition"]), ways)


def _case(run: Interpreter, node: RubyNode) -> Value:
    subject = node.fields.get("value")
    value = run.evaluate(subject) if subject else None
    deciding = value.influences if value else frozenset()
    clauses = [part for part in node.parts if part.type in {"when", "else"}]
    taken = None
    for clause in clauses:
        if clause.type == "else":
            taken = clause
            break
        patterns = elements(run, [p.parts[0] for p in clause.parts if p.type == "pattern"])
        deciding = deciding.union(*(pattern.influences for pattern in patterns))
        if any(_matches(run, pattern, value, clause) for pattern in patterns):
            taken = clause.fields.get("body")
            break
    with run.influenced_by(Value(None, deciding)):
        result = run.evaluate(taken) if taken else NIL
    for clause in clauses:
        if clause is not taken and clause.fields.get("body") is not taken:
            mark_untaken(run, clause, deciding)
    return Value(result.data, result.parameters | deciding)


def _matches(run: Interpreter, pattern: Value, value: Value | None, node: RubyNode) -> bool:
    """Compare as `pattern === value` does; without a value, the pattern is the condition."""
    if value is None:
        return pattern.truthy
    if isinstance(pattern.data, RubyRange):
        number = value.data
        first, last = pattern.data.first, pattern.data.last
        if type(number) not in {int, float} or not isinstance(number, (int, float)):
            return False
        return first <= number < last if pattern.data.exclusive else first <= number <= last
    if isinstance(pattern.data, Constant):
        name = class_name(value.data)
        return pattern.data.name == name or (pattern.data.name, name) in {
            ("Numeric", "Integer"),
            ("Numeric", "Float"),
        }
    try:
        return equal(pattern.data, value.data, run.budget)
    except ValueError as error:
        raise Unreadable(node.span, f"compares arrays {error}") from None


def _while(run: Interpreter, node: RubyNode) -> Value:
    wanted = node.type in {"while", "while_modifier"}
    body, condition_node = node.fields["body"], node.fields["condition"]
    first = node.type.endswith("modifier") and body.type == "begin"
    scope = run.scope
    while True:
        condition = Value(None) if first else run.evaluate(condition_node)
        if not first and condition.truthy is not wanted:
            return NIL
        first = False
        run.budget.spend()
        try:
            with run.influenced_by(condition):
                run.evaluate(body)
        except Continued as jump:
            if jump.scope is not scope:
                raise
        except Broken as jump:
            if jump.scope is not scope:
                raise
            return jump.value


def _for(run: Interpreter, node: RubyNode) -> Value:
    pattern, body, scope = node.fields["pattern"], node.fields["body"], run.scope
    collection = run.evaluate(node.fields["value"].parts[0])
    for item in items_of(run, collection, node):
        run.budget.spend()
        assign(run, pattern, item)
        try:
            run.evaluate(body)
        except Continued as jump:
            if jump.scope is not scope:
                raise
        except Broken as jump:
            if jump.scope is not scope:
                raise
            return jump.value
    return collection


def _argument(run: Interpreter, node: RubyNode) -> Value:
    """Return what a jump carries: nothing, one value, or an array of several."""
    values = elements(run, [value for part in node.parts for value in part.parts])
    if not values:
        return NIL
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
    return run.value(Symbol(function.name))


def _of(names: Iterable[str], handler: Handler) -> dict[str, Handler]:
    return dict.fromkeys(names, handler)


STATEMENTS: Mapping[str, Handler] = MappingProxyType(
    {
        "program": _program,
        **_of(("then", "do", "else", "ensure", "parenthesized_statements"), _statements),
        **_of(("body_statement", "block_body", "begin"), _body),
        "rescue_modifier": _rescue_modifier,
        **_of(("if", "elsif", "conditional"), _if),
        "unless": _unless,
        **_of(("if_modifier", "unless_modifier"), _if_modifier),
        "case": _case,
        **_of(("while", "until", "while_modifier", "until_modifier"), _while),
        "for": _for,
        "return": _return,
        "break": _break,
        "next": _next,
        "method": _define,
    }
)
