"""The piece that a Ruby text lacks: with it, the grammar understands all of it.

A valid text on which the grammar fails does not become one that it understands by an `end`, a quote
or a bracket too many; so a text that does lacked the piece. Each repair is tried, within bounds.
"""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import chain, islice

from checker.source.ruby import (
    MAX_SECONDS,
    ParsesTooSlowly,
    RubyNode,
    is_understood,
    parse_ruby,
)
from checker.source.text import SourceText, Span

SyntaxFault = tuple[Span, str]
_Repair = tuple[str, SyntaxFault]
"""A text that may be understood, and what is wrong if it is."""

_MAX_REPAIRS = 400
"""Texts that are tried; one of a real spawner takes half a millisecond."""
_MAX_ENDS = 4
_SUSPECTS = 4
_CLOSING = {"(": ")", "[": "]", "{": "}", "#{": "}"}
_CLOSERS = frozenset({*_CLOSING.values(), "end"})
_BLOCKS = frozenset({"def", "do", "begin", "case", "class", "module"})
_LOOPS = frozenset({"while", "until", "for"})
_CONDITIONS = frozenset({"if", "unless", *_LOOPS})
_LITERALS = frozenset({"string", "regex"})
_QUOTES = ('"', "'")
_OPENING = re.compile(r"<<[-~]?[\"'`]?([A-Z]\w*)")
_WORD_ALONE = re.compile(r"^[ \t]*([A-Z]\w*)[ \t]*$", re.MULTILINE)


def find_repair(
    tree: RubyNode, nodes: Sequence[RubyNode], errors: Sequence[RubyNode]
) -> SyntaxFault | None:
    """Return what a text lacks, if one piece, or the pieces that close it, correct all of it."""
    until = time.thread_time() + MAX_SECONDS
    tokens = [node for node in nodes if not node.children and not node.named and not node.missing]
    opened, surplus = _unpaired(tokens)
    suspects = _suspects(nodes, errors)
    repairs = chain(
        _grammars(tree, nodes),
        _closed_at_the_end(tree, opened),
        _closed_at_the_end(tree, _unpaired(tokens, _QUOTES)[0]),
        _removals(tree, surplus),
        _heredocs(tree, nodes),
        _quotes(tree, suspects),
        _brackets(tree, opened, suspects),
        _opening_brackets(tree, surplus),
    )
    try:
        return _missing_end(tree, until) or next(
            (fault for text, fault in islice(repairs, _MAX_REPAIRS) if is_understood(text, until)),
            None,
        )
    except ParsesTooSlowly:
        return None


def _missing_end(tree: RubyNode, until: float) -> SyntaxFault | None:
    """Return which part is open to the end of the file, if only its `end` is missing."""
    text = tree.source.text
    for count in range(1, _MAX_ENDS + 1):
        whole = text + "\nend" * count
        if is_understood(whole, until):
            parts = parse_ruby(SourceText(tree.source.file, whole)).parts
            part = next((part for part in parts if part.end > len(text)), None)
            if part is None or not part.children:
                return None
            inner = _misplaced(part) if count == 1 else None
            return _opened(tree, (inner or part).children[0])
    return None


def _misplaced(part: RubyNode) -> RubyNode | None:
    """Return the innermost block in a part that takes the `end` of a block around it.

    Such an `end` is not indented like the line in which its block starts.
    """
    found = None
    for node in part.walk():
        first, last = (node.children or [node])[0], (node.children or [node])[-1]
        closed = last.type == "end" and not first.named and "\n" in node.text
        if closed and _indentation(first) != _indentation(last):
            found = node
    return found


def _indentation(token: RubyNode) -> int:
    """Return how far the line of a token is indented."""
    text = token.source.text
    start = text.rfind("\n", 0, token.start) + 1
    return len(text[start : token.start]) - len(text[start : token.start].lstrip())


def _opened(tree: RubyNode, token: RubyNode) -> SyntaxFault:
    """Return the fault of a token that nothing closes."""
    span = Span(tree.source, token.start, token.end)
    if token.type in _CLOSING:
        return span, f"this {token.type} is not closed; write {_CLOSING[token.type]}"
    if token.type in _QUOTES:
        return span, f"the string is not closed; write {token.type} at its end"
    what = "the definition" if token.type == "def" else "the statement"
    return span, f"missing end: {what} that starts here is not closed"


def _grammars(tree: RubyNode, nodes: Sequence[RubyNode]) -> Iterator[_Repair]:
    """Insert what the grammar invents; a quote is judged from its opening."""
    for node in nodes:
        for child in node.children:
            if child.missing and not child.named and node.children[0] is not child:
                text = _insert(tree.source.text, child.start, child.type)
                yield text, _opened(tree, node.children[0])


def _unpaired(
    tokens: Sequence[RubyNode], quotes: Sequence[str] = ()
) -> tuple[list[RubyNode], list[RubyNode]]:
    """Return the tokens that open and are not closed, and those that close and were not opened."""
    opened: list[RubyNode] = []
    surplus: list[RubyNode] = []
    for token in tokens:
        if opened and _closing(opened[-1]) == token.type:
            opened.pop()
        elif token.type in _CLOSING or token.type in quotes or _opens_block(token, opened):
            opened.append(token)
        elif token.type in _CLOSERS:
            surplus.append(token)
    return opened, surplus


def _closing(token: RubyNode) -> str:
    return token.type if token.type in _QUOTES else _CLOSING.get(token.type, "end")


def _opens_block(token: RubyNode, opened: Sequence[RubyNode]) -> bool:
    if token.type == "do":
        return not (opened and opened[-1].type in _LOOPS)
    if token.type in _CONDITIONS:
        line = token.source.text.rfind("\n", 0, token.start) + 1
        return token.source.text[line : token.start].rstrip(" \t=") == ""
    return token.type in _BLOCKS


def _closed_at_the_end(tree: RubyNode, opened: Sequence[RubyNode]) -> Iterator[_Repair]:
    """Close all that is open, as in a text that was cut off."""
    if opened:
        closing = (_closing(token) for token in reversed(opened))
        yield tree.source.text + "\n".join(closing), _opened(tree, opened[0])
        closing = (_closing(token) for token in reversed(opened))
        yield "\n".join((tree.source.text, *closing)), _opened(tree, opened[0])


def _removals(tree: RubyNode, surplus: Sequence[RubyNode]) -> Iterator[_Repair]:
    text = tree.source.text
    for token in surplus[:_SUSPECTS]:
        yield text[: token.start] + text[token.end :], unexpected(token)


def unexpected(token: RubyNode) -> SyntaxFault:
    """Return the fault of an `end`, an `else` or a bracket without a start."""
    if token.text in _CLOSERS:
        return token.span, f"unexpected {token.text}: nothing is open that it closes"
    return token.span, f"unexpected {token.text}: no statement here can have one"


def missing_comma(source: SourceText, end: int) -> SyntaxFault:
    """Return the fault of a list without a comma after the value that ends at an offset."""
    return Span(source, end - 1, end), "missing comma: write ',' after this"


def _opening_brackets(tree: RubyNode, surplus: Sequence[RubyNode]) -> Iterator[_Repair]:
    text = tree.source.text
    opening = {closing: opening for opening, closing in _CLOSING.items() if len(opening) == 1}
    for token in surplus[:_SUSPECTS]:
        for at in range(_line(text, token.start)[0], token.start):
            yield _insert(text, at, opening.get(token.type, "")), unexpected(token)


def _heredocs(tree: RubyNode, nodes: Sequence[RubyNode]) -> Iterator[_Repair]:
    """Open a heredoc above what the grammar does not understand, for a word that closes none."""
    text = tree.source.text
    inner = [node.start for node in nodes if node.type == "ERROR"]
    ends = Counter(match.group(1) for match in _WORD_ALONE.finditer(text))
    opened = Counter(match.group(1) for match in _OPENING.finditer(text))
    starts = {match.start(1) for match in _WORD_ALONE.finditer(text)}
    for node in nodes:
        alone = node.type == "constant" and node.start in starts
        if alone and ends[node.text] > opened[node.text]:
            message = f"{node.text} closes no heredoc; write <<-{node.text} before its text"
            fault = (node.span, message)
            for at in inner[:_SUSPECTS]:
                end = _line(text, text.rfind("\n", 0, at))[1]
                yield _insert(text, end, f" <<-{node.text}"), fault


def _suspects(nodes: Sequence[RubyNode], errors: Sequence[RubyNode]) -> list[int]:
    """Return where a quote may be missing: at errors, and where strings of several lines begin."""
    inner = [node.start for node in innermost(errors)]
    strings = [node.start for node in nodes if node.type in _LITERALS and "\n" in node.text]
    quotes = [
        child.start
        for node in errors
        for child in node.children
        if child.type in _QUOTES and not child.missing
    ]
    above = [start for at in inner[:1] for start in _lines_above(nodes[0].source.text, at)]
    starts = [start for each in (inner, strings, quotes, above) for start in each[:_SUSPECTS]]
    return list(dict.fromkeys(starts))


def _lines_above(text: str, at: int) -> Iterator[int]:
    for _ in range(_SUSPECTS):
        at = max(0, text.rfind("\n", 0, at))
        yield at


def innermost(errors: Sequence[RubyNode]) -> list[RubyNode]:
    """Return the errors that contain no other: one of them may reach over the whole file."""
    known = set(errors)
    return [node for node in errors if known.isdisjoint(node.children)]


def _line(text: str, at: int) -> tuple[int, int]:
    """Return where the line of an offset starts, and where its text ends."""
    start = text.rfind("\n", 0, at) + 1
    end = text.find("\n", at)
    return start, start + len(text[start : end if end >= 0 else len(text)].rstrip())


def _quotes(tree: RubyNode, suspects: Sequence[int]) -> Iterator[_Repair]:
    """Insert a quote into lines that have an odd number of them."""
    text = tree.source.text
    for start, end in dict.fromkeys(_line(text, at) for at in suspects):
        line = text[start:end]
        for quote in _QUOTES:
            if line.count(quote) % 2:
                at = start + line.index(quote)
                message = f"the line has an odd number of {quote}; add one"
                fault = (Span(tree.source, at, at + 1), message)
                yield from ((_insert(text, i, quote), fault) for i in _gaps(text, start, end))


def _brackets(
    tree: RubyNode, opened: Sequence[RubyNode], suspects: Sequence[int]
) -> Iterator[_Repair]:
    """Close a bracket in its line, or where the grammar ceases to understand."""
    text = tree.source.text
    for token in [token for token in opened if token.type in _CLOSING][:_SUSPECTS]:
        places = [*_gaps(text, token.end, _line(text, token.start)[1]), *suspects]
        for at in places:
            yield _insert(text, at, _CLOSING[token.type]), _opened(tree, token)


def _gaps(text: str, start: int, end: int) -> list[int]:
    """Return the end of a stretch of text, and where words and signs meet in it."""
    return [end, *(start + gap.start() for gap in re.finditer(r"\b|(?<=\W)", text[start:end]))]


def _insert(text: str, at: int, piece: str) -> str:
    return text[:at] + piece + text[at:]
