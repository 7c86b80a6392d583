"""Evaluates an expression node by node, in the scopes that its comprehensions and lambdas open."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from typing import Any, Protocol

from xacro import NameSpace, YamlDictWrapper

from checker.formats.xacro.expression.bounds import (
    Allowance,
    Budget,
    RefusedExpression,
    check_bits,
)
from checker.formats.xacro.expression.builtins import Function, counting, is_of
from checker.formats.xacro.expression.format import formatted
from checker.formats.xacro.expression.methods import METHODS, TAKING_A_KEY, method_of
from checker.formats.xacro.expression.operators import (
    apply_binary,
    apply_comparison,
    apply_unary,
)
from checker.formats.xacro.expression.syntax import parse
from checker.formats.xacro.expression.values import (
    LAZY,
    MAPPINGS,
    PLAIN,
    consumed,
    plain,
    spend_on_keys,
    type_label,
    weigh,
)

_UNBOUND = object()
_CONVERSIONS = {-1: "", 115: "s", 114: "r", 97: "a"}
Found = tuple[Callable[..., Any], frozenset[int | str]]
"""Function of a call, without budget and arguments, and the arguments that may be functions."""


class Names(Protocol):
    """Lookup of names that an expression does not bind itself."""

    def __getitem__(self, name: str, /) -> Any:
        """Return what a name represents, or raise KeyError."""


class _Scope:
    """The names that a comprehension or a lambda binds."""

    def __init__(self, names: Iterable[str], outer: _Scope | None) -> None:
        self.values: dict[str, Any] = dict.fromkeys(names, _UNBOUND)
        self.outer = outer


class _Evaluation:
    """The evaluation of one expression; `_WORKS` lists the nodes that it knows."""

    def __init__(self, names: Names, budget: Budget) -> None:
        self._names = names
        self._budget = budget

    def value(self, node: ast.AST, scope: _Scope | None) -> Any:
        """Return the value of a node: data, or what yields its items one by one."""
        self._budget.spend()
        work = _WORKS.get(type(node))
        if work is None:
            raise RefusedExpression(type(node).__name__)
        return work(self, node, scope)

    def _data(self, node: ast.AST, scope: _Scope | None) -> Any:
        """Return the value of a node if it is data, such as an item of a list."""
        return plain(self.value(node, scope))

    # Names and attributes.

    def named(self, node: ast.Name | ast.Attribute, scope: _Scope | None) -> Any:
        value = self._resolved(node, scope)
        if type(value) in PLAIN or type(value) in LAZY:
            return value
        if type(value) is Function:
            raise RefusedExpression(f"the function {value.name} as a value")
        raise RefusedExpression(f"{ast.unparse(node)[:40]} as a value")

    def _resolved(self, node: ast.AST, scope: _Scope | None) -> Any:
        """Return what a node represents, which may be a function or a namespace."""
        if type(node) is ast.Name:
            return self._look_up(node.id, scope)
        if type(node) is ast.Attribute:
            return _attribute(self._resolved(node.value, scope), node.attr)
        return self.value(node, scope)

    def _look_up(self, name: str, scope: _Scope | None) -> Any:
        while scope is not None:
            if name in scope.values:
                value = scope.values[name]
                if value is _UNBOUND:
                    raise UnboundLocalError(
                        f"cannot access local variable {name!r} "
                        "where it is not associated with a value"
                    )
                return value
            scope = scope.outer
        try:
            return self._names[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None

    # Operators, comparisons, conditions.

    def binary(self, node: ast.BinOp, scope: _Scope | None) -> Any:
        chain = [node]
        while type(chain[-1].left) is ast.BinOp:
            chain.append(chain[-1].left)
        left = self.value(chain[-1].left, scope)
        for operation in reversed(chain):
            right = self.value(operation.right, scope)
            left = apply_binary(type(operation.op), left, right, self._budget)
        return left

    def unary(self, node: ast.UnaryOp, scope: _Scope | None) -> Any:
        return apply_unary(type(node.op), self.value(node.operand, scope))

    def boolean(self, node: ast.BoolOp, scope: _Scope | None) -> Any:
        ends_it = type(node.op) is ast.Or
        for operand in node.values[:-1]:
            value = self.value(operand, scope)
            if bool(value) is ends_it:
                return value
        return self.value(node.values[-1], scope)

    def comparison(self, node: ast.Compare, scope: _Scope | None) -> Any:
        left = self.value(node.left, scope)
        result: Any = True
        for operator, operand in zip(node.ops, node.comparators, strict=True):
            right = self.value(operand, scope)
            result = apply_comparison(type(operator), left, right, self._budget)
            if not result:
                break
            left = right
        return result

    def conditional(self, node: ast.IfExp, scope: _Scope | None) -> Any:
        return self.value(node.body if self.value(node.test, scope) else node.orelse, scope)

    # Constants, displays, subscripts.

    def constant(self, node: ast.Constant, _: _Scope | None) -> Any:
        if type(node.value) is int:
            check_bits(node.value.bit_length())
        return plain(node.value)

    def subscript(self, node: ast.Subscript, scope: _Scope | None) -> Any:
        value = self.value(node.value, scope)
        if type(node.slice) is ast.Slice:
            part = node.slice
            ends = (
                None if bound is None else self._data(bound, scope)
                for bound in (part.lower, part.upper, part.step)
            )
            if type(value) in PLAIN and hasattr(type(value), "__len__"):
                self._budget.spend_on_copy(len(value))
            return value[slice(*ends)]
        key = self._data(node.slice, scope)
        return value[self._key(key, value) if type(value) in MAPPINGS else key]

    def _key(self, key: Any, among: Any) -> Any:
        """Return a key, once its hash and its look-up are paid for."""
        weigh(key, self._budget)
        spend_on_keys([key], len(among), self._budget)
        return key

    def _items(self, nodes: list[ast.expr], scope: _Scope | None) -> Iterator[Any]:
        """Yield the values of the elements of a display or a call; `*x` is all items of x."""
        for node in nodes:
            if type(node) is ast.Starred:
                yield from consumed(self.value(node.value, scope), self._budget)
            else:
                yield self._data(node, scope)

    def list_display(self, node: ast.List, scope: _Scope | None) -> list[Any]:
        return list(self._items(node.elts, scope))

    def tuple_display(self, node: ast.Tuple, scope: _Scope | None) -> tuple[Any, ...]:
        return tuple(self._items(node.elts, scope))

    def set_display(self, node: ast.Set, scope: _Scope | None) -> set[Any]:
        return self._keys(self._items(node.elts, scope))

    def _keys(self, items: Iterable[Any]) -> set[Any]:
        result: set[Any] = set()
        for item in items:
            result.add(self._key(item, result))
        return result

    def dict_display(self, node: ast.Dict, scope: _Scope | None) -> dict[Any, Any]:
        result: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            if key is not None:
                at = self._data(key, scope)
                result[self._key(at, result)] = self._data(value, scope)
                continue
            more = self.value(value, scope)
            if type(more) not in MAPPINGS:
                raise TypeError(f"{type(more).__name__!r} object is not a mapping")
            spend_on_keys(more, len(result) + len(more), self._budget)
            result |= dict(consumed(more, self._budget))
        return result

    def joined_text(self, node: ast.JoinedStr, scope: _Scope | None) -> str:
        text = "".join(self._part(part, scope) for part in node.values)
        self._budget.spend_on_text(len(text))
        return text

    def _part(self, node: ast.expr, scope: _Scope | None) -> str:
        if type(node) is not ast.FormattedValue:
            return str(self._data(node, scope))
        value = self._data(node.value, scope)
        spec = "" if node.format_spec is None else self._data(node.format_spec, scope)
        return formatted(value, _CONVERSIONS[node.conversion], spec, self._budget)

    # Comprehensions.

    def list_comprehension(self, node: ast.ListComp, outer: _Scope | None) -> list[Any]:
        return list(self.generator(node, outer))

    def set_comprehension(self, node: ast.SetComp, outer: _Scope | None) -> set[Any]:
        return self._keys(self.generator(node, outer))

    def generator(
        self, node: ast.GeneratorExp | ast.ListComp | ast.SetComp, outer: _Scope | None
    ) -> Iterator[Any]:
        scope, rounds = self._begin(node.generators, outer)
        return (self._data(node.elt, scope) for _ in rounds)

    def dict_comprehension(self, node: ast.DictComp, outer: _Scope | None) -> dict[Any, Any]:
        scope, rounds = self._begin(node.generators, outer)
        result: dict[Any, Any] = {}
        for _ in rounds:
            key = self._key(self._data(node.key, scope), result)
            result[key] = self._data(node.value, scope)
        return result

    def _begin(
        self, clauses: list[ast.comprehension], outer: _Scope | None
    ) -> tuple[_Scope, Iterator[None]]:
        first = iter(self.value(clauses[0].iter, outer))
        scope = _Scope((name for clause in clauses for name in _bound(clause.target)), outer)
        return scope, self._rounds(clauses, first, scope)

    def _rounds(
        self, clauses: list[ast.comprehension], first: Iterator[Any], scope: _Scope
    ) -> Iterator[None]:
        """Yield once for each round, with the names of that round bound."""
        clause, rest = clauses[0], clauses[1:]
        for item in first:
            self._budget.spend()
            self._bind(clause.target, item, scope)
            if not all(self.value(condition, scope) for condition in clause.ifs):
                continue
            if rest:
                yield from self._rounds(rest, iter(self.value(rest[0].iter, scope)), scope)
            else:
                yield

    def _bind(self, target: ast.expr, item: Any, scope: _Scope) -> None:
        if type(target) is ast.Name:
            scope.values[target.id] = item
            return
        targets: list[ast.expr] = target.elts  # type: ignore[attr-defined]
        count = len(targets)
        try:
            values = list(islice(item, count + 1))
        except TypeError:
            raise TypeError(f"cannot unpack non-iterable {type(item).__name__} object") from None
        self._budget.spend(len(values))
        if len(values) > count:
            raise ValueError(f"too many values to unpack (expected {count})")
        if len(values) < count:
            raise ValueError(f"not enough values to unpack (expected {count}, got {len(values)})")
        for part, value in zip(targets, values, strict=True):
            self._bind(part, value, scope)

    # Calls, and the lambda functions that are passed to them.

    def call(self, node: ast.Call, scope: _Scope | None) -> Any:
        if type(node.func) is ast.Attribute:
            work, takes = self._through_dot(node.func, scope)
        else:
            work, takes = _function(self._resolved(node.func, scope))
        if work is is_of and len(node.args) == 2:
            value = self._data(node.args[0], scope)
            return work(self._budget, value, self._kinds(node.args[1], scope))
        positional = self._positional(node, scope, takes)
        return work(self._budget, *positional, **self._keywords(node, scope, takes))

    def _through_dot(self, node: ast.Attribute, scope: _Scope | None) -> Found:
        """Return what `x.name(…)` calls: a method, or a function of a namespace."""
        base = self._resolved(node.value, scope)
        kind = type(base)
        if kind is NameSpace or (kind is YamlDictWrapper and node.attr not in METHODS[kind]):
            return _function(_attribute(base, node.attr))
        if kind not in PLAIN and kind not in LAZY:
            raise RefusedExpression(f"{ast.unparse(node)[:40]}()")
        method = method_of(base, node.attr)
        return (
            lambda budget, *arguments, **named: method(budget, base, *arguments, **named),
            TAKING_A_KEY.get(method, frozenset()),
        )

    def _positional(
        self, node: ast.Call, scope: _Scope | None, takes: frozenset[int | str]
    ) -> list[Any]:
        if takes and any(type(argument) is ast.Starred for argument in node.args[:1]):
            takes = frozenset()
        values: list[Any] = []
        for number, argument in enumerate(node.args):
            if number in takes:
                values.append(self._function_or_value(argument, scope))
            elif type(argument) is ast.Starred:
                values.extend(self._items([argument], scope))
            else:
                values.append(self.value(argument, scope))
        return values

    def _keywords(
        self, node: ast.Call, scope: _Scope | None, takes: frozenset[int | str]
    ) -> dict[str, Any]:
        named: dict[str, Any] = {}
        for keyword in node.keywords:
            if keyword.arg is None:
                more = self.value(keyword.value, scope)
                if type(more) not in MAPPINGS:
                    raise TypeError("argument after ** must be a mapping")
                more = dict(consumed(more, self._budget))
            elif keyword.arg in takes:
                more = {keyword.arg: self._function_or_value(keyword.value, scope)}
            else:
                more = {keyword.arg: self.value(keyword.value, scope)}
            if named.keys() & more.keys():
                raise TypeError("a keyword argument is given twice")
            if not all(type(name) is str for name in more):
                raise TypeError("keywords must be strings")
            named |= more
        return named

    def _function_or_value(self, node: ast.expr, scope: _Scope | None) -> Any:
        """Return an argument that may be a function, as functions of Python take it."""
        if type(node) is ast.Lambda:
            return self._lambda(node, scope)
        if type(node) in (ast.Name, ast.Attribute):
            value = self._resolved(node, scope)
            if type(value) is Function:
                return counting(value, self._budget)
        return self._data(node, scope)

    def _lambda(self, node: ast.Lambda, scope: _Scope | None) -> Callable[..., Any]:
        """Return what evaluates the body; it ends with the expression."""
        of = node.args
        if of.vararg or of.kwarg or of.kwonlyargs:
            raise RefusedExpression("a lambda function with other than plain parameters")
        parameters = [parameter.arg for parameter in (*of.posonlyargs, *of.args)]
        defaults = [self._data(default, scope) for default in of.defaults]

        def called(*arguments: Any) -> Any:
            missing = len(parameters) - len(arguments)
            if not 0 <= missing <= len(defaults):
                raise TypeError(
                    f"<lambda>() takes {len(parameters)} arguments, {len(arguments)} are given"
                )
            inner = _Scope(parameters, scope)
            values = (*arguments, *defaults[len(defaults) - missing :])
            inner.values.update(zip(parameters, map(plain, values), strict=True))
            return self._data(node.body, inner)

        return called

    def lone_lambda(self, _: ast.Lambda, __: _Scope | None) -> Any:
        raise RefusedExpression(
            "a lambda function that is not an argument of map, filter, sorted, min or max"
        )

    def _kinds(self, node: ast.expr, scope: _Scope | None) -> tuple[type, ...]:
        """Return the types that the second argument of `isinstance` names."""
        if type(node) is ast.Tuple:
            return tuple(kind for elt in node.elts for kind in self._kinds(elt, scope))
        if type(node) in (ast.Name, ast.Attribute):
            value = self._resolved(node, scope)
            if type(value) is Function and value.stands_for is not None:
                return (value.stands_for,)
        raise RefusedExpression("isinstance() with other than the types of data")


_WORKS: Mapping[type[ast.AST], Callable[[_Evaluation, Any, _Scope | None], Any]] = {
    ast.Constant: _Evaluation.constant,
    ast.Name: _Evaluation.named,
    ast.Attribute: _Evaluation.named,
    ast.Subscript: _Evaluation.subscript,
    ast.List: _Evaluation.list_display,
    ast.Tuple: _Evaluation.tuple_display,
    ast.Set: _Evaluation.set_display,
    ast.Dict: _Evaluation.dict_display,
    ast.JoinedStr: _Evaluation.joined_text,
    ast.BinOp: _Evaluation.binary,
    ast.UnaryOp: _Evaluation.unary,
    ast.BoolOp: _Evaluation.boolean,
    ast.Compare: _Evaluation.comparison,
    ast.IfExp: _Evaluation.conditional,
    ast.Call: _Evaluation.call,
    ast.Lambda: _Evaluation.lone_lambda,
    ast.ListComp: _Evaluation.list_comprehension,
    ast.SetComp: _Evaluation.set_comprehension,
    ast.DictComp: _Evaluation.dict_comprehension,
    ast.GeneratorExp: _Evaluation.generator,
}
"""The whole language: what each type of node means."""


def _attribute(value: Any, name: str) -> Any:
    """Return what a dot leads to: a name of a namespace, or a key of what was read from YAML.

    Raises:
        AttributeError: It has no such key, or what it is has no attributes of that name.
        NameError: The namespace has no such name.
        RefusedExpression: It would be an attribute of Python's.
    """
    kind = type(value)
    if kind is NameSpace and not hasattr(NameSpace, name) and name not in vars(value):
        try:
            return value[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None
    if kind is YamlDictWrapper and not hasattr(YamlDictWrapper, name):
        return getattr(value, name)
    if kind in PLAIN and not hasattr(kind, name):
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")
    raise RefusedExpression(f"the attribute .{name} of {type_label(value)}")


def _function(value: Any) -> Found:
    if type(value) is Function:
        return value.work, value.takes
    if type(value) in PLAIN or type(value) in LAZY:
        raise TypeError(f"{type(value).__name__!r} object is not callable")
    raise RefusedExpression("a call of a namespace")


def _bound(target: ast.expr) -> Iterator[str]:
    """Yield the names that a comprehension binds."""
    if type(target) is ast.Name:
        yield target.id
    elif type(target) in (ast.Tuple, ast.List):
        for elt in target.elts:  # type: ignore[attr-defined]
            yield from _bound(elt)
    else:
        raise RefusedExpression("a comprehension that binds other than names")


def evaluate(text: str, names: Names, allowance: Allowance | None = None) -> Any:
    """Return the value of an expression, which is data.

    Args:
        text: The text as written, without `${` and `}`.
        names: What its names represent: data, functions, or namespaces of these.
        allowance: Steps that are left to all expressions of a file.

    Raises:
        RefusedExpression: It uses what the language does not have.
        ExpressionLimit: It takes more than it may.
        Exception: What Python raises for it.
    """
    tree = parse(text)
    budget = Budget(allowance)
    try:
        result = _Evaluation(names, budget).value(tree, None)
        weigh(result, budget)
    finally:
        budget.close()
    return result
