"""CMake's language: commands and their arguments, each with its place.

The grammar is cmake-language(7): comments and bracket comments, quoted, unquoted and bracket
arguments, parentheses inside arguments. One pass, no recursion.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterator
from itertools import islice

from checker.base.record import Record
from checker.source.text import Located, SourceText, Span

MAX_TOKENS = 200_000
_TOKEN = re.compile(
    r"(?P<blank>[ \t\r\n\ufeff]+)"
    r"|(?P<comment>\#?)\[(?P<equals>=*)\["
    r"|(?P<line>\#[^\n]*)"
    r"|(?P<paren>[()])"
    r'|(?P<quote>")'
    r'|(?P<word>(?:[^\s()"\#\\]+|\\.)(?:[^\s()"\#\\]+|\\.|"[^"\n]*")*)',
    re.DOTALL,
)
_QUOTED = re.compile(r'[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_ESCAPE = re.compile(r"\\(\r?\n|.)", re.DOTALL)
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "\n": "", "\r\n": "", ";": "\\;", "$": "\\$"}


class ArgumentKind(enum.Enum):
    """Form of an argument: only unquoted ones are split at `;`."""

    UNQUOTED = "unquoted"
    QUOTED = "quoted"
    BRACKET = "bracket"
    PAREN = "parenthesis"


class CMakeFault(Record, eq=False):
    """One fault of a CMake file."""

    span: Span
    message: str


class Argument(Record, eq=False):
    """One argument as written, escapes read; `${…}` is in it unchanged.

    The span has no quotes around it.
    """

    kind: ArgumentKind
    text: Located[str]


class Command(Record, eq=False):
    """One call, `name(arguments)`; the name in lower case, as CMake reads it."""

    name: Located[str]
    arguments: tuple[Argument, ...]
    span: Span


class _Tokens:
    """Cuts a text into arguments, and keeps the parts that are not closed."""

    def __init__(self, source: SourceText, faults: list[CMakeFault]) -> None:
        self._source = source
        self._faults = faults

    def __iter__(self) -> Iterator[Argument]:
        text, at = self._source.text, 0
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                self._fault(at, at + 1, f"{text[at]!r} is not allowed here")
                return
            elif match["equals"] is not None:
                at, argument = self._bracket(match)
                if argument:
                    yield argument
            elif match["quote"]:
                at, argument = self._quoted(at)
                yield argument
            else:
                at = match.end()
                if match["paren"]:
                    yield self._argument(ArgumentKind.PAREN, *match.span())
                elif match["word"]:
                    yield self._argument(ArgumentKind.UNQUOTED, *match.span())

    def _fault(self, start: int, end: int, message: str) -> None:
        self._faults.append(CMakeFault(Span(self._source, start, end), message))

    def _argument(self, kind: ArgumentKind, start: int, end: int) -> Argument:
        span = Span(self._source, start, end)
        text = span.text
        if kind in {ArgumentKind.QUOTED, ArgumentKind.UNQUOTED} and "\\" in text:
            text = _ESCAPE.sub(lambda match: _ESCAPED.get(match[1], match[1]), text)
        return Argument(kind, Located(text, span))

    def _quoted(self, at: int) -> tuple[int, Argument]:
        closed = _QUOTED.match(self._source.text, at + 1)
        end = closed.end() - 1 if closed else len(self._source.text)
        if closed is None:
            self._fault(at, at + 1, "the quotation mark is never closed")
        return end + 1, self._argument(ArgumentKind.QUOTED, at + 1, end)

    def _bracket(self, opening: re.Match[str]) -> tuple[int, Argument | None]:
        closing = f"]{opening['equals']}]"
        end = self._source.text.find(closing, opening.end())
        if end < 0:
            self._fault(*opening.span(), f"{opening.group()} is never closed by {closing}")
            end = len(self._source.text)
        argument = self._argument(ArgumentKind.BRACKET, opening.end(), end)
        return end + len(closing), None if opening["comment"] else argument


def read_commands(source: SourceText, faults: list[CMakeFault]) -> Iterator[Command]:
    """Yield the commands of a CMake file up to its first fault, where CMake stops, too."""
    tokens = islice(_Tokens(source, faults), MAX_TOKENS)
    for name in tokens:
        if not _is_name(name):
            message = f"{name.text.value[:40]!r} is not a command"
            faults.append(CMakeFault(name.text.span, message))
            return
        opening = next(tokens, None)
        if opening is None or not _is_paren(opening, "("):
            message = f"{name.text.value[:40]!r} is not followed by a parenthesis"
            faults.append(CMakeFault(name.text.span, message))
            return
        arguments, end = _arguments(tokens)
        if end is None:
            message = f"the parenthesis of {name.text.value[:40]}() is never closed"
            faults.append(CMakeFault(name.text.span, message))
            end = len(source.text)
        located = Located(name.text.value.lower(), name.text.span)
        yield Command(located, tuple(arguments), Span(source, name.text.span.start, end))
        if faults:
            return


def _arguments(tokens: Iterator[Argument]) -> tuple[list[Argument], int | None]:
    """Return the arguments of a call and where its parenthesis closes."""
    arguments: list[Argument] = []
    depth = 1
    for token in tokens:
        depth += _is_paren(token, "(") - _is_paren(token, ")")
        if depth == 0:
            return arguments, token.text.span.end
        arguments.append(token)
    return arguments, None


def _is_paren(token: Argument, paren: str) -> bool:
    return token.kind is ArgumentKind.PAREN and token.text.value == paren


def _is_name(token: Argument) -> bool:
    return token.kind is ArgumentKind.UNQUOTED and bool(_NAME.match(token.text.value))
