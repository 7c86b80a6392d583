"""Syntax errors that are certain.

The grammar also fails on some valid Ruby, so only what cannot be anything else is named here:
the first fault of a file, at a place up to which everything was understood.
"""

from __future__ import annotations

from checker.source.ruby import RubyNode, heredoc_identifier
from checker.source.text import Span

SyntaxFault = tuple[Span, str]

_QUOTES = frozenset({'"', "'"})


def syntax_faults(tree: RubyNode) -> tuple[SyntaxFault, ...]:
    """Return the first certain syntax error of a file, if there is one."""
    nodes = tree.walk()
    errors = [node for node in nodes if node.type == "ERROR" or node.missing]
    first = min((node.start for node in errors), default=len(tree.source.text))
    for check in (_open_heredoc, _stray_end, _open_string, _open_definition):
        fault = check(tree, nodes, errors, first)
        if fault is not None:
            return (fault,)
    return ()


def _open_heredoc(
    tree: RubyNode, nodes: list[RubyNode], _errors: list[RubyNode], first: int
) -> SyntaxFault | None:
    last = {line.strip(): at for at, line in enumerate(tree.source.text.split("\n"), 1)}
    for node in nodes:
        if node.type != "heredoc_beginning" or node.start >= first:
            continue
        word = heredoc_identifier(node)
        if word and last.get(word, 0) <= tree.source.position(node.end)[0]:
            return node.span, f"the heredoc {node.text} is never closed by a line '{word}'"
    return None


def _stray_end(
    tree: RubyNode, _nodes: list[RubyNode], _errors: list[RubyNode], first: int
) -> SyntaxFault | None:
    """The parser takes an `end` that closes nothing for a name, which no name can be."""
    for node in tree.parts:
        if node.type == "identifier" and node.start < first and node.text == "end":
            return node.span, "this end closes nothing"
    return None


def _open_string(
    tree: RubyNode, _nodes: list[RubyNode], errors: list[RubyNode], first: int
) -> SyntaxFault | None:
    """A quote opens a string, and no further quote follows in the file."""
    text = tree.source.text
    if first < len(text) and text[first] in _QUOTES and text[first] not in text[first + 1 :]:
        token = any(
            child.start == first and not child.named for node in errors for child in node.children
        )
        if token:
            return Span(tree.source, first, first + 1), "the string is never closed"
    return None


def _open_definition(
    tree: RubyNode, nodes: list[RubyNode], errors: list[RubyNode], _first: int
) -> SyntaxFault | None:
    """The only thing not understood is a `def` whose `end` is missing at the end of the file."""
    if len(errors) != 1 or tree.source.text.rstrip()[-3:] not in {"end"}:
        return None
    tokens = [child for child in errors[0].children if not child.named]
    opening = next((token for token in tokens if token.type == "def"), None)
    plain = all(token.type in {"def", "(", ")", ",", ";"} for token in tokens)
    reached = errors[0].end >= len(tree.source.text.rstrip())
    strays = any(node.type == "identifier" and node.text == "end" for node in nodes)
    if opening is None or not plain or not reached or strays:
        return None
    return opening.span, "an end is missing: the definition that starts here is never closed"
