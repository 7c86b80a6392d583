"""Ruby's string literals: raw stretches of source to text, escape by escape."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from checker.expand.spawner.signals import Unreadable
from checker.expand.spawner.traced import Piece, TracedString
from checker.source.text import SourceText, Span

_ESCAPED = re.compile(
    r"\r\n|\\(?:u\{[0-9A-Fa-f\s]{1,200}\}|u[0-9A-Fa-f]{4}|x[0-9A-Fa-f]{1,2}|[0-7]{1,3}|\r\n|.)",
    re.DOTALL,
)
_SIMPLE = {
    "n": "\n",
    "t": "\t",
    "r": "\r",
    "s": " ",
    "a": "\a",
    "b": "\b",
    "e": "\x1b",
    "f": "\f",
    "v": "\v",
    "\n": "",
    "\r\n": "",
}
_CARRIAGE_RETURN = re.compile(r"\r\n")

Range = tuple[int, int]


def decode_double(
    source: SourceText, ranges: Iterable[Range], parameters: frozenset[str]
) -> TracedString:
    """Read stretches of a literal in which escapes count.

    Raises:
        Unreadable: An escape that makes single bytes or control characters.
    """
    return _decode(source, ranges, parameters, _ESCAPED)


def decode_raw(
    source: SourceText, ranges: Iterable[Range], parameters: frozenset[str]
) -> TracedString:
    """Read stretches of a literal without any escapes, such as a heredoc of `<<'XML'`."""
    return _decode(source, ranges, parameters, _CARRIAGE_RETURN)


def decode_single(
    source: SourceText, ranges: Iterable[Range], parameters: frozenset[str], quotes: str
) -> TracedString:
    """Read a literal in single quotes: only its quotes and the backslash can be escaped."""
    pattern = re.compile(rf"\r\n|\\[\\{re.escape(quotes)}]")
    return _decode(source, ranges, parameters, pattern)


def _decode(
    source: SourceText,
    ranges: Iterable[Range],
    parameters: frozenset[str],
    pattern: re.Pattern[str],
) -> TracedString:
    pieces = [
        Piece(text, Span(source, start, end), True, parameters)
        for first, last in ranges
        for text, start, end in _stretches(source, first, last, pattern)
        if text
    ]
    return TracedString(tuple(pieces))


def _stretches(
    source: SourceText, start: int, end: int, pattern: re.Pattern[str]
) -> Iterator[tuple[str, int, int]]:
    """Yield plain stretches and escapes, each with its range in the source."""
    at = start
    for found in pattern.finditer(source.text, start, end):
        yield source.text[at : found.start()], at, found.start()
        yield _unescaped(source, found), found.start(), found.end()
        at = found.end()
    yield source.text[at:end], at, end


def _unescaped(source: SourceText, found: re.Match[str]) -> str:
    whole = found.group()
    if whole == "\r\n":
        return "\n"
    body = whole[1:]
    if body in _SIMPLE:
        return _SIMPLE[body]
    if body[0] == "u" and len(body) > 1:
        codes = [int(code, 16) for code in body.strip("u{}").split()]
    elif body[0] == "x" and len(body) > 1:
        codes = [int(body[1:], 16)]
    elif body[0] in "01234567":
        codes = [int(body, 8)]
    elif body[0] in "cCMux":
        codes = [-1]
    else:
        return body
    single_byte = body[0] != "u" and codes[0] > 127
    if single_byte or any(not 0 <= code <= 0x10FFFF or 0xD800 <= code < 0xE000 for code in codes):
        raise Unreadable(
            Span(source, found.start(), found.end()), f"uses the escape {whole}, which is not read"
        )
    return "".join(chr(code) for code in codes)
