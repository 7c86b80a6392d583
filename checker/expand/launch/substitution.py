"""Substitutions of roslaunch: `$(arg x)`, `$(dirname)`, `$(eval …)` and those left alone.

What only the launching machine knows (`find`, `env`, `optenv`, `anon`) stays as it is written.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping

from checker.base.record import Record
from checker.expand.launch.graph import LaunchFaultKind

# `$(eval …)`: comparisons, logic, arithmetic and joining of strings over the args.
#
# roslaunch hands the expression to Python. Here Python's own grammar is read with `ast`, and a few
# kinds of nodes are evaluated; everything else is not known. Nothing is executed.


Value = str | int | float | bool

MAX_EXPRESSION = 400
MAX_DEPTH = 40
_LARGEST = 10**100


class Unknown(Record):
    """The expression asks for something that this reader does not evaluate."""


class ExpressionFault(Record):
    """The expression is wrong: roslaunch stops at it.

    `undeclared` names the arg that is not declared, else it is empty.
    """

    message: str
    undeclared: str = ""


class _Stop(Exception):
    """Ends an evaluation with `outcome`."""

    def __init__(self, outcome: Unknown | ExpressionFault) -> None:
        super().__init__()
        self.outcome = outcome


_COMPARISONS: dict[type[ast.cmpop], Callable[[Value, Value], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_ARITHMETIC: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_SIGNS: dict[type[ast.unaryop], Callable[[float], float]] = {
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_CONSTANTS: dict[str, Value] = {"true": True, "false": False}


def evaluate(expression: str, args: Mapping[str, str]) -> Value | Unknown | ExpressionFault:
    """Evaluate an expression.

    Args:
        expression: The text between `$(eval ` and `)`.
        args: Values of the declared args; as names they count as numbers or truth values when
            they read so.
    """
    if len(expression) > MAX_EXPRESSION:
        return Unknown()
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return ExpressionFault(f"{expression.strip()!r} is not a Python expression")
    except (RecursionError, MemoryError):
        return Unknown()
    try:
        return _Evaluation(args).value(tree.body, 0)
    except _Stop as stop:
        return stop.outcome
    except (ArithmeticError, TypeError, ValueError) as error:
        return ExpressionFault(f"{expression.strip()!r} fails: {error}")


def convert(text: str) -> Value:
    """Read an arg's text as roslaunch does: int, float, truth value, else text."""
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        return _CONSTANTS.get(text.lower(), text)


class _Evaluation:
    def __init__(self, args: Mapping[str, str]) -> None:
        self._args = args

    def value(self, node: ast.expr, depth: int) -> Value:  # noqa: PLR0911 - one per kind of node
        if depth > MAX_DEPTH:
            raise _Stop(Unknown())
        match node:
            case ast.Constant(value=str() | int() | float() as value):
                return value
            case ast.Name(id=name):
                return self._name(name)
            case ast.Call(func=ast.Name(id="arg"), args=[ast.Constant(value=str(name))]):
                return self._arg(name)
            case ast.BoolOp(op=op, values=values):
                return self._logic(op, values, depth + 1)
            case ast.Compare():
                return self._compare(node, depth + 1)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return not self.value(operand, depth + 1)
            case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _SIGNS:
                return _SIGNS[type(sign)](_number(self.value(operand, depth + 1)))
            case ast.BinOp(left=left, op=op, right=right):
                return _binary(op, self.value(left, depth + 1), self.value(right, depth + 1))
        raise _Stop(Unknown())

    def _name(self, name: str) -> Value:
        return _CONSTANTS[name] if name in _CONSTANTS else self._arg(name)

    def _arg(self, name: str) -> Value:
        text = self._args.get(name)
        if text is None:
            message = f"the arg {name!r} is used but not declared"
            raise _Stop(ExpressionFault(message, undeclared=name))
        if "$(" in text:
            raise _Stop(Unknown())
        return convert(text)

    def _logic(self, op: ast.boolop, values: list[ast.expr], depth: int) -> Value:
        stops_at = isinstance(op, ast.Or)
        result: Value = not stops_at
        for node in values:
            result = self.value(node, depth)
            if bool(result) is stops_at:
                break
        return result

    def _compare(self, node: ast.Compare, depth: int) -> bool:
        left = self.value(node.left, depth)
        for op, right_node in zip(node.ops, node.comparators, strict=True):
            compare = _COMPARISONS.get(type(op))
            if compare is None:
                raise _Stop(Unknown())
            right = self.value(right_node, depth)
            if not compare(left, right):
                return False
            left = right
        return True


def _binary(op: ast.operator, left: Value, right: Value) -> Value:
    if isinstance(op, ast.Add) and isinstance(left, str) and isinstance(right, str):
        return left + right
    calculate = _ARITHMETIC.get(type(op))
    if calculate is None:
        raise _Stop(Unknown())
    result = calculate(_number(left), _number(right))
    if isinstance(result, int) and abs(result) > _LARGEST:
        raise _Stop(Unknown())
    return result


def _number(value: Value) -> float:
    if isinstance(value, str):
        raise TypeError(f"{value!r} is not a number")
    return value


MAX_LENGTH = 20_000
_SUBSTITUTION = re.compile(r"\$\(([^()]*)\)")
_MACHINE = {"find", "env", "optenv", "anon"}
_EVAL = "$(eval "


class SubstitutionFault(Record):
    """What is wrong with `text[start:end]`."""

    kind: LaunchFaultKind
    start: int
    end: int
    message: str


class Substituted(Record):
    """A text with its substitutions made, and the faults met."""

    text: str
    faults: tuple[SubstitutionFault, ...] = ()


def is_known(text: str) -> bool:
    """Whether nothing in a substituted text is left to the launching machine."""
    return "$(" not in text


def substitute(text: str, args: Mapping[str, str], directory: str) -> Substituted:
    """Make the substitutions of a text.

    Args:
        text: An attribute's value.
        args: Values of the declared args.
        directory: What `$(dirname)` stands for.
    """
    if "$(" not in text:
        return Substituted(text)
    if text.startswith(_EVAL) and text.endswith(")"):
        return _substitute_expression(text, args)
    parts: list[str] = []
    faults: list[SubstitutionFault] = []
    length = last = 0
    for match in _SUBSTITUTION.finditer(text):
        value = _value(match.group(1), args, directory)
        if isinstance(value, SubstitutionFault):
            faults.append(SubstitutionFault(value.kind, *match.span(), value.message))
            value = None
        parts += [text[last : match.start()], match.group() if value is None else value]
        last = match.end()
        length += len(parts[-2]) + len(parts[-1])
        if length > MAX_LENGTH:
            return _too_long(text)
    return Substituted("".join((*parts, text[last:])), tuple(faults))


def _value(content: str, args: Mapping[str, str], directory: str) -> str | SubstitutionFault | None:
    """Return what a substitution stands for; None when only the launching machine knows."""
    command, *words = content.split() or [""]
    if command == "arg":
        if len(words) != 1:
            message = f"$({content}) must name one arg"
            return SubstitutionFault(LaunchFaultKind.SUBSTITUTION, 0, 0, message)
        value = args.get(words[0])
        return undeclared(words[0]) if value is None else value
    if command == "dirname" and not words:
        return directory
    if command in _MACHINE and words:
        return None
    message = f"$({content}) is not a substitution of roslaunch"
    return SubstitutionFault(LaunchFaultKind.SUBSTITUTION, 0, 0, message)


def _too_long(text: str) -> Substituted:
    message = f"the text has more than {MAX_LENGTH} characters"
    return Substituted(text, (SubstitutionFault(LaunchFaultKind.LIMIT, 0, len(text), message),))


def undeclared(name: str) -> SubstitutionFault:
    """Return the fault of using an arg that is not declared."""
    message = f"the arg {name!r} is used but not declared"
    return SubstitutionFault(LaunchFaultKind.UNDECLARED_ARG, 0, 0, message)


def _substitute_expression(text: str, args: Mapping[str, str]) -> Substituted:
    result = evaluate(text[len(_EVAL) : -1], args)
    if isinstance(result, Unknown):
        return Substituted(text)
    if isinstance(result, ExpressionFault):
        kind = LaunchFaultKind.SUBSTITUTION
        if result.undeclared:
            kind = LaunchFaultKind.UNDECLARED_ARG
        return Substituted(text, (SubstitutionFault(kind, 0, len(text), result.message),))
    value = str(result)
    return Substituted(value) if len(value) <= MAX_LENGTH else _too_long(text)
