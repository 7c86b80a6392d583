"""Expressions of launch files in Python.

What Python would refuse, and what this reader does not know, is `Unknown`, with its reason.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from checker.formats.xacro.expression.bounds import Budget, ExpressionLimit, RefusedExpression
from checker.formats.xacro.expression.format import formatted
from checker.formats.xacro.expression.operators import COMPARISONS, UNARY, apply_binary
from checker.launch.ros2.graph import Condition, display_path, is_known
from checker.launch.ros2.python.scope import Scope
from checker.launch.ros2.values import (
    Choice,
    FilePath,
    Guarded,
    HandledError,
    Made,
    PlacedText,
    Unknown,
    Value,
    add_place,
    chosen_value,
    is_substitution,
)

if TYPE_CHECKING:
    from checker.launch.ros2.python.interpreter import Interpreter

PATHS = ("PathSubstitution", "PathJoinSubstitution")
"""Substitutions to which `/` appends a path."""
_ITEMS_LIMIT = 5_000
_DATA_LIMIT = 20_000
_LEVELS_LIMIT = 40
_SHOWN = 160
"""Greatest number of characters of a text in a message."""


def plain(value: Value) -> Any:
    """Return a value as Python's own data.

    Raises:
        RefusedExpression: It is none, or it is not known before the launch.
        ExpressionLimit: It contains too much.
    """
    return _Plain().of(value, 0)


class _Plain:
    """The making of plain data; lists that contain one list twice are counted in full."""

    def __init__(self) -> None:
        self._left = _DATA_LIMIT

    def of(self, value: Value, level: int) -> Any:
        self._left -= 1
        if self._left < 0 or level > _LEVELS_LIMIT:
            raise ExpressionLimit("has too much or too deeply nested data")
        value = chosen_value(value)
        if value is None or type(value) in (int, float, bool, range):
            return value
        if type(value) in (list, tuple, set, frozenset):
            return type(value)([self.of(item, level + 1) for item in value])
        if type(value) is dict:
            pairs = value.items()
            return {self.of(k, level + 1): self.of(item, level + 1) for k, item in pairs}
        if isinstance(value, FilePath):
            return self.of(value.text, level)
        return _plain_text(value)


def _plain_text(value: Value) -> str:
    if isinstance(value, str):
        if not is_known(value):
            text = display_path(value)
            text = text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"
            raise RefusedExpression(f"{text}, which is not known before the launch")
        return str(value)
    if isinstance(value, Unknown):
        raise RefusedExpression(value.reason)
    raise RefusedExpression("a value that is only known when it is launched")


def bounded(run: Interpreter, node: ast.AST, work: Callable[[Budget], Value]) -> Value:
    """Return the result of some work on data; Unknown when Python, or this reader, refuses it.

    Raises:
        HandledError: Python raises an error that the launch file handles.
    """
    run.allowance.spend()
    try:
        return add_place(work(Budget()), run.span(node))
    except RefusedExpression as refused:
        return run.unknown(node, _reason(str(refused)))
    except ExpressionLimit as limit:
        return run.unknown(node, f"the expression {limit}")
    except RecursionError:
        return run.unknown(node, "the expression is nested too deeply")
    except HandledError:
        raise
    except Exception as error:
        names = frozenset(kind.__name__ for kind in type(error).__mro__)
        if run.handles(names):
            raise HandledError(names) from error
        return run.unknown(node, f"the expression raises {type(error).__name__}: {str(error)[:80]}")


def _reason(refused: str) -> str:
    return refused if " " in refused else f"{refused} is not evaluated"


def evaluate(run: Interpreter, node: ast.expr, scope: Scope) -> Value:
    """Return the value of an expression."""
    run.allowance.spend()
    with run.allowance:
        handler = _HANDLERS.get(type(node))
        if handler is None:
            return run.unknown(node, f"{type(node).__name__} is not evaluated")
        return handler(run, node, scope)


def _constant(run: Interpreter, node: ast.Constant, _: Scope) -> Value:
    if isinstance(node.value, str):
        run.allowance.spend_on_text(len(node.value))
        return PlacedText(node.value, run.span(node))
    if node.value is None or type(node.value) in (int, float, bool):
        return node.value
    return run.unknown(node, "the constant is not evaluated")


def _name(run: Interpreter, node: ast.Name, scope: Scope) -> Value:
    holder = scope.holder(node.id)
    if holder is None:
        return run.builtin(node.id) or run.unknown(node, f"{node.id} is not defined")
    if node.id in holder.by_argument:
        run.by_argument = True
    value = holder.values[node.id]
    # A choice stays one, so that what is started under either condition is seen.
    if isinstance(value, Choice) and any(v.holds is True for v in value.values):
        return chosen_value(value)
    return value


def _attribute(run: Interpreter, node: ast.Attribute, scope: Scope) -> Value:
    owner = chosen_value(evaluate(run, node.value, scope))
    return run.attribute(owner, node.attr, node)


def _joined(run: Interpreter, node: ast.JoinedStr, scope: Scope) -> Value:
    parts: list[str] = []
    for part in node.values:
        value = evaluate(run, part, scope)
        if not isinstance(value, str):
            return value if isinstance(value, Unknown) else run.unknown(part, "is not text")
        parts.append(str(value))
        run.allowance.spend_on_text(sum(map(len, parts)))
    return PlacedText("".join(parts), run.span(node))


def _formatted(run: Interpreter, node: ast.FormattedValue, scope: Scope) -> Value:
    value = chosen_value(evaluate(run, node.value, scope))
    if isinstance(value, FilePath):
        value = PlacedText(value.text, run.span(node))
    plain_form = node.format_spec is None and node.conversion in (-1, ord("s"))
    if plain_form and isinstance(value, str):
        return PlacedText(value, run.span(node))
    if isinstance(value, Made):
        return run.unknown(node, f"a text is made of a {value.name} before the launch")
    spec = evaluate(run, node.format_spec, scope) if node.format_spec else ""
    conversion = chr(node.conversion) if node.conversion >= 0 else ""
    return bounded(
        run, node, lambda budget: formatted(plain(value), conversion, plain(spec), budget)
    )


def sequence(run: Interpreter, nodes: Iterable[ast.expr], scope: Scope) -> list[Value]:
    """Return the items of a list display, starred ones unpacked."""
    items: list[Value] = []
    for node in nodes:
        if isinstance(node, ast.Starred):
            items += each(run, evaluate(run, node.value, scope), node)
        else:
            items.append(evaluate(run, node, scope))
    return items


def each(run: Interpreter, value: Value, node: ast.AST) -> list[Value]:
    """Return the items of a value; of one that is not known, one that is not."""
    if isinstance(value, Choice):
        run.allowance.spend(len(value.values))
        return [
            Guarded(item, choice.conditions)
            for choice in value.values
            for item in each(run, choice.value, node)
        ]
    if isinstance(value, Guarded):
        return [Guarded(item, value.conditions) for item in each(run, value.value, node)]
    if isinstance(value, str) and is_known(value):
        run.allowance.spend(len(value))
        return [add_place(character, run.span(node)) for character in str(value)]
    if (
        isinstance(value, list | tuple | set | frozenset | dict | range)
        and len(value) < _ITEMS_LIMIT
    ):
        run.allowance.spend(len(value))
        return [*value]
    if isinstance(value, Unknown):
        return [value]
    return [run.unknown(node, "the items are not known")]


def _list(run: Interpreter, node: ast.List, scope: Scope) -> Value:
    return sequence(run, node.elts, scope)


def _tuple(run: Interpreter, node: ast.Tuple, scope: Scope) -> Value:
    return tuple(sequence(run, node.elts, scope))


def _set(run: Interpreter, node: ast.Set, scope: Scope) -> Value:
    # The order of a set is not known; that in which it is written is as good as any.
    return bounded(run, node, lambda _: [*dict.fromkeys(plain(sequence(run, node.elts, scope)))])


def _dict(run: Interpreter, node: ast.Dict, scope: Scope) -> Value:
    entries: dict[Value, Value] = {}
    for key_node, value_node in zip(node.keys, node.values, strict=True):
        value = evaluate(run, value_node, scope)
        if key_node is None:
            value = chosen_value(value)
            if not isinstance(value, dict):
                reason = value.reason if isinstance(value, Unknown) else "it is not a dictionary"
                return run.unknown(value_node, reason)
            run.allowance.spend(len(value))
            entries |= value
            continue
        key = hashable(run, evaluate(run, key_node, scope), key_node)
        if isinstance(key, Unknown):
            return key
        entries[key] = value
    return entries


def hashable(run: Interpreter, key: Value, node: ast.AST) -> Value:
    """Return what may be a key; substitutions are, by what they are and not by their text."""
    key = chosen_value(key)
    if key is None or isinstance(key, str | int | float | bool | Made):
        return key
    if isinstance(key, tuple):
        run.allowance.spend(len(key))  # a tuple may hold another one many times
        parts = tuple(hashable(run, part, node) for part in key)
        return next((part for part in parts if isinstance(part, Unknown)), parts)
    return key if isinstance(key, Unknown) else run.unknown(node, "the key is not evaluated")


def _binary(run: Interpreter, node: ast.BinOp, scope: Scope) -> Value:
    left = evaluate(run, node.left, scope)
    right = evaluate(run, node.right, scope)
    return binary(run, node.op, left, right, node)


def binary(  # noqa: PLR0911 - one per kind of values
    run: Interpreter, kind: ast.operator, left: Value, right: Value, node: ast.AST
) -> Value:
    """Return what an operator makes of two values."""
    if (
        isinstance(kind, ast.Add)
        and isinstance(left, list | Choice)
        and isinstance(right, list | Choice)
    ):
        run.allowance.spend(1)
        return [*each(run, left, node), *each(run, right, node)]
    left, right = chosen_value(left), chosen_value(right)
    for side in (left, right):
        if isinstance(side, Unknown):
            return side
    if isinstance(kind, ast.Add) and type(left) is type(right) and isinstance(left, tuple):
        run.allowance.spend(len(left) + len(right))
        return left + right
    if isinstance(kind, ast.Add) and isinstance(left, str) and isinstance(right, str):
        run.allowance.spend_on_text(len(left) + len(right))
        return PlacedText(str(left) + str(right), run.span(node))
    if isinstance(kind, ast.Div) and isinstance(left, FilePath):
        return run.joined_path([left, right], node)
    if isinstance(kind, ast.Div) and isinstance(left, Made) and left.name in PATHS:
        return Made("PathJoinSubstitution", {"substitutions": [left, right]}, run.span(node))
    if isinstance(kind, ast.Mult) and isinstance(left, list | tuple) and type(right) is int:
        run.allowance.spend(len(left) * max(right, 0) + 1)
        return left * right
    if isinstance(kind, ast.BitOr) and isinstance(left, dict) and isinstance(right, dict):
        return left | right
    return bounded(
        run, node, lambda budget: apply_binary(type(kind), plain(left), plain(right), budget)
    )


def _unary(run: Interpreter, node: ast.UnaryOp, scope: Scope) -> Value:
    if isinstance(node.op, ast.Not):
        truth = run.truth(evaluate(run, node.operand, scope))
        return run.unknown(node, "its truth is not known") if truth is None else not truth
    value = evaluate(run, node.operand, scope)
    return bounded(run, node, lambda _: UNARY[type(node.op)](_number(plain(value))))


def _number(value: Any) -> Any:
    if type(value) not in (int, float, bool):
        raise TypeError("bad operand type")
    return value


def _boolean(run: Interpreter, node: ast.BoolOp, scope: Scope) -> Value:
    stops_at = isinstance(node.op, ast.Or)
    value: Value = not stops_at
    unknown: Value = None
    for part in node.values:
        value = chosen_value(evaluate(run, part, scope))
        truth = run.truth(value)
        if truth is stops_at:
            return value
        if truth is None:
            unknown = unknown or run.unknown(part, "its truth is not known")
    return unknown or value


def _compare(run: Interpreter, node: ast.Compare, scope: Scope) -> Value:
    left = chosen_value(evaluate(run, node.left, scope))
    for kind, right_node in zip(node.ops, node.comparators, strict=True):
        right = chosen_value(evaluate(run, right_node, scope))
        result = _compared(run, kind, left, right, node)
        if result is not True:
            return result
        left = right
    return True


def _compared(run: Interpreter, kind: ast.cmpop, left: Value, right: Value, node: ast.AST) -> Value:
    for side in (left, right):
        if isinstance(side, Unknown):
            return side
    if isinstance(kind, ast.Is | ast.IsNot) or left is None or right is None:
        if isinstance(kind, ast.Is | ast.Eq):
            return left is right
        if isinstance(kind, ast.IsNot | ast.NotEq):
            return left is not right
    if isinstance(kind, ast.Eq | ast.NotEq) and (is_substitution(left) or is_substitution(right)):
        differs = isinstance(kind, ast.NotEq)
        if isinstance(left, str) or isinstance(right, str):
            run.misuse(node, "true" if differs else "false")
        return differs
    if isinstance(kind, ast.In | ast.NotIn) and isinstance(right, dict):
        right = [*right]
    work = COMPARISONS[type(kind)]
    return bounded(run, node, lambda budget: _spent(work, plain(left), plain(right), budget))


def _spent(work: Callable[[Any, Any], Any], left: Any, right: Any, budget: Budget) -> Any:
    budget.spend(sum(len(side) for side in (left, right) if hasattr(side, "__len__")))
    return work(left, right)


def _if_expression(run: Interpreter, node: ast.IfExp, scope: Scope) -> Value:
    truth, condition = run.test(node.test, scope)
    if truth is not None:
        return evaluate(run, node.body if truth else node.orelse, scope)
    first = Guarded(evaluate(run, node.body, scope), (condition,))
    return Choice((first, Guarded(evaluate(run, node.orelse, scope), (negate(condition),))))


def negate(condition: Condition) -> Condition:
    """Return the condition of the other branch."""
    holds = None if condition.holds is None else not condition.holds
    return Condition(condition.text, not condition.wanted, holds, condition.written)


def _subscript(run: Interpreter, node: ast.Subscript, scope: Scope) -> Value:
    owner = chosen_value(evaluate(run, node.value, scope))
    if isinstance(owner, Unknown):
        return owner
    if isinstance(node.slice, ast.Slice):
        return _slice(run, owner, node.slice, scope)
    key = chosen_value(evaluate(run, node.slice, scope))
    if isinstance(key, Unknown):
        return key
    return run.item(owner, key, node)


def _slice(run: Interpreter, owner: Value, node: ast.Slice, scope: Scope) -> Value:
    bounds = [
        None if part is None else evaluate(run, part, scope)
        for part in (node.lower, node.upper, node.step)
    ]
    if isinstance(owner, list | tuple):
        run.allowance.spend(len(owner))
        return bounded(run, node, lambda _: owner[slice(*map(plain, bounds))])
    return bounded(run, node, lambda _: plain(owner)[slice(*map(plain, bounds))])


def _lambda(run: Interpreter, node: ast.Lambda, scope: Scope) -> Value:
    return run.function(node, scope)


def _comprehension(run: Interpreter, node: Any, scope: Scope) -> Value:
    return [
        evaluate(run, node.elt, inner)
        for inner in _rounds(run, node.generators, Scope(outer=scope))
    ]


def _dict_comprehension(run: Interpreter, node: ast.DictComp, scope: Scope) -> Value:
    entries: dict[Value, Value] = {}
    for inner in _rounds(run, node.generators, Scope(outer=scope)):
        key = hashable(run, evaluate(run, node.key, inner), node.key)
        if isinstance(key, Unknown):
            return key
        entries[key] = evaluate(run, node.value, inner)
    return entries


def _rounds(run: Interpreter, generators: list[ast.comprehension], scope: Scope) -> Iterator[Scope]:
    """Yield the scope of each round; what a filter leaves undecided counts."""
    first, *rest = generators
    for item in each(run, evaluate(run, first.iter, scope), first.iter):
        run.allowance.spend()
        inner = Scope(outer=scope)
        run.assign(first.target, item, inner)
        if any(run.test(test, inner)[0] is False for test in first.ifs):
            continue
        if rest:
            yield from _rounds(run, rest, inner)
        else:
            yield inner


def _call(run: Interpreter, node: ast.Call, scope: Scope) -> Value:
    return run.call(node, scope)


def _starred(run: Interpreter, node: ast.Starred, _: Scope) -> Value:
    return run.unknown(node, "a star is not allowed here")


def _formatted_field(run: Interpreter, node: ast.NamedExpr, scope: Scope) -> Value:
    value = evaluate(run, node.value, scope)
    run.assign(node.target, value, scope)
    return value


def _yield(run: Interpreter, node: ast.Yield | ast.YieldFrom, scope: Scope) -> Value:
    """Add to what the generator gives: all of it is computed at once."""
    if scope.yielded is None:
        return run.unknown(node, "yield outside of a function is not evaluated")
    value = evaluate(run, node.value, scope) if node.value is not None else None
    items = each(run, value, node) if isinstance(node, ast.YieldFrom) else [value]
    scope.yielded += run.guarded(items)
    return None


_HANDLERS: Mapping[type[ast.AST], Callable[[Interpreter, Any, Scope], Value]] = {
    ast.Constant: _constant,
    ast.Name: _name,
    ast.Attribute: _attribute,
    ast.JoinedStr: _joined,
    ast.FormattedValue: _formatted,
    ast.List: _list,
    ast.Tuple: _tuple,
    ast.Set: _set,
    ast.Dict: _dict,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.BoolOp: _boolean,
    ast.Compare: _compare,
    ast.IfExp: _if_expression,
    ast.Subscript: _subscript,
    ast.Lambda: _lambda,
    ast.ListComp: _comprehension,
    ast.GeneratorExp: _comprehension,
    ast.SetComp: _comprehension,
    ast.DictComp: _dict_comprehension,
    ast.Call: _call,
    ast.Starred: _starred,
    ast.NamedExpr: _formatted_field,
    ast.Yield: _yield,
    ast.YieldFrom: _yield,
}
