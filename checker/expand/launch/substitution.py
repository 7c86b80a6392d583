"""Substitutions of roslaunch: `$(arg x)`, `$(dirname)`, `$(eval …)` and those left alone.

What only the launching machine knows (`find`, `env`, `optenv`, `anon`) stays as it is written.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from checker.base.record import Record
from checker.expand.launch.expression import ExpressionFault, Unknown, evaluate
from checker.expand.launch.graph import LaunchFaultKind

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
    for found in _SUBSTITUTION.finditer(text):
        value = _value(found.group(1), args, directory)
        if isinstance(value, SubstitutionFault):
            faults.append(SubstitutionFault(value.kind, *found.span(), value.message))
            value = None
        parts += [text[last : found.start()], found.group() if value is None else value]
        last = found.end()
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
    message = f"$({content}) is no substitution that roslaunch knows"
    return SubstitutionFault(LaunchFaultKind.SUBSTITUTION, 0, 0, message)


def _too_long(text: str) -> Substituted:
    message = f"the text grows beyond {MAX_LENGTH} characters"
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
