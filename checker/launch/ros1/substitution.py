"""Substitutions of roslaunch: `$(arg x)`, `$(dirname)`, `$(eval …)` and those left alone.

What depends on the launching machine (`find`, `env`, `optenv`, `anon`) stays as it is written.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from checker.base.record import Record
from checker.launch.ros1.graph import LaunchFaultKind

Value = str | int | float | bool

MAX_EXPRESSION = 400
_CONSTANTS: Mapping[str, Value] = {"true": True, "false": False}
_BUILTINS = ("list", "dict", "map", "str", "float", "int")
"""Built-in functions that roslaunch offers, besides all of `math`."""


class Unknown(Record):
    """The expression needs something that this reader does not evaluate."""


class ExpressionFault(Record):
    """The expression is wrong: roslaunch stops at it.

    `undeclared` names the arg that is not declared, else it is empty.
    """

    message: str
    undeclared: str = ""


class _NotKnown(Exception):
    """The expression uses what only the launching machine knows."""


class _Undeclared(Exception):
    """The expression uses an arg that is not declared; the text is its name."""


class _Names:
    """The names that roslaunch gives to an expression."""

    def __init__(self, args: Mapping[str, str]) -> None:
        self._args = args

    def __getitem__(self, name: str) -> Any:
        from checker.formats.xacro.expression.builtins import FUNCTIONS, Function
        from checker.formats.xacro.symbols import NAMES

        if name in _CONSTANTS:
            return _CONSTANTS[name]
        if name == "arg":
            return Function(name, lambda _, name: self._arg(name))
        if name in (*_MACHINE, "dirname"):
            raise _NotKnown
        if name in self._args:
            return self._arg(name)
        if name in _BUILTINS:
            return FUNCTIONS[name]
        return NAMES[name] if name in NAMES else self._arg(name)

    def _arg(self, name: str) -> Value:
        text = self._args.get(name)
        if text is None:
            raise _Undeclared(name)
        if not is_known(text):
            raise _NotKnown
        return convert(text)


def evaluate(expression: str, args: Mapping[str, str]) -> Value | Unknown | ExpressionFault:
    """Evaluate an expression as roslaunch does with Python's `eval`; here nothing is executed.

    Args:
        expression: The text between `$(eval ` and `)`.
        args: Values of the declared args; as names they count as numbers or truth values when
            they read so.
    """
    from checker.formats.xacro.expression import bounds, evaluation

    if len(expression) > MAX_EXPRESSION:
        return Unknown()
    try:
        value = evaluation.evaluate(expression, _Names(args))
    except SyntaxError:
        return ExpressionFault(f"{expression.strip()!r} is not a Python expression")
    except _Undeclared as name:
        return ExpressionFault(undeclared(str(name)).message, str(name))
    except (_NotKnown, bounds.RefusedExpression, bounds.ExpressionLimit):
        return Unknown()
    except Exception as error:  # noqa: BLE001 - whatever Python raises for it
        return ExpressionFault(f"{expression.strip()!r} fails: {error}")
    return value if isinstance(value, Value) else Unknown()


def convert(text: str) -> Value:
    """Read an arg's text as roslaunch does: int, float, truth value, else text."""
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        return _CONSTANTS.get(text.lower(), text)


MAX_LENGTH = 20_000
_SUBSTITUTION = re.compile(r"\$\(([^()]*)\)")
_MACHINE = {"find", "env", "optenv", "anon"}
_EVAL = "$(eval "


class SubstitutionFault(Record):
    """Fault in `text[start:end]`."""

    kind: LaunchFaultKind
    start: int
    end: int
    message: str


class Substituted(Record):
    """A text with its substitutions made, and the faults met."""

    text: str
    faults: tuple[SubstitutionFault, ...] = ()


def is_known(text: str) -> bool:
    """Return whether a substituted text does not depend on the machine that launches."""
    return "$(" not in text


def substitute(text: str, args: Mapping[str, str], directory: str) -> Substituted:
    """Make the substitutions of a text.

    Args:
        text: An attribute's value.
        args: Values of the declared args.
        directory: What `$(dirname)` represents.
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
    """Return what a substitution represents; None if only the launching machine knows."""
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
