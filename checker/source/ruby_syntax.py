"""Syntax errors of a Ruby text, as far as they are certain.

The grammar fails on hardly any valid Ruby, but it does, and it accepts some that Ruby refuses. So a
fault is named only with a proof: something that Ruby never accepts (`ruby_refusals.py`), at a place
up to which the grammar understood everything; or a repair (`ruby_repairs.py`) that makes it
understand the whole.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from checker.source.ruby import RubyNode, heredoc_identifier
from checker.source.ruby_refusals import first_refusal
from checker.source.ruby_repairs import SyntaxFault, find_repair, innermost, missing_comma
from checker.source.text import Span

_QUOTES = frozenset({'"', "'"})
_LISTS = frozenset({"array", "argument_list", "method_parameters"})
_VALUE = re.compile(r"[\w.]+")
_OPTIONS = re.compile(r".?[imxounse]*")
_LAST_WORD = re.compile(r"(\w+)([ \t]*)\Z")
_METHODS = frozenset({"method", "singleton_method"})
_PARAMETERS = frozenset({"method_parameters", "block_parameters"})


def syntax_faults(tree: RubyNode) -> tuple[SyntaxFault, ...]:
    """Return the first certain syntax error of a file, if there is one."""
    nodes = tree.walk()
    errors = _errors(nodes)
    first = min((_place(node) for node in innermost(errors)), default=len(tree.source.text))
    for check in (_open_heredoc, _open_string, first_refusal, _side_by_side):
        fault = check(tree, nodes, first)
        if fault is not None:
            return (fault,)
    fault = find_repair(tree, nodes, errors) if errors else None
    return (fault,) if fault is not None else ()


def not_understood(tree: RubyNode) -> Span | None:
    """Return the first place that the grammar does not understand, or understands wrongly."""
    nodes = tree.walk()
    places = [*_misread_heredocs(nodes), *map(_first_line, innermost(_errors(nodes)))]
    return min(places, key=lambda place: place.start, default=None)


def _first_line(node: RubyNode) -> Span:
    line = node.source.text.find("\n", node.start)
    return Span(node.source, node.start, min(node.end, line if line >= 0 else node.end))


def _misread_heredocs(nodes: Sequence[RubyNode]) -> Iterator[Span]:
    """Yield lines that end a heredoc for the grammar alone, and openings that are operators."""
    variables = _variables(nodes)
    for node in nodes:
        end = _end_line(node)
        if end is not None and not _closes(end.text, node):
            yield end
        if node.type == "heredoc_beginning" and _appends(node, variables):
            yield node.span


def _errors(nodes: Sequence[RubyNode]) -> list[RubyNode]:
    """Return what the grammar could not parse or made up, and patterns that Ruby refuses."""
    return [
        node
        for node in nodes
        if node.type == "ERROR" or node.missing or (node.type == "regex" and _strange(node))
    ]


def _strange(pattern: RubyNode) -> bool:
    """Return whether a pattern has unknown options: it is no pattern, but text or division."""
    return not (pattern.children and _OPTIONS.fullmatch(pattern.children[-1].text))


def _place(error: RubyNode) -> int:
    """Return where an error is: what reaches to the end of the file lacks something there."""
    text = error.source.text
    return len(text) if error.end >= len(text.rstrip()) else error.start


# Heredocs and strings.


def _open_heredoc(tree: RubyNode, nodes: Sequence[RubyNode], first: int) -> SyntaxFault | None:
    lines = tree.source.text.split("\n")
    variables = _variables(nodes)
    last = {line.rstrip("\r"): at for at, line in enumerate(lines, 1)}
    last_indented = {line.lstrip().rstrip("\r"): at for at, line in enumerate(lines, 1)}
    for node in nodes:
        if node.type != "heredoc_beginning" or node.start >= first:
            continue
        if _appends(node, variables):
            continue
        word = heredoc_identifier(node)
        ends = last_indented if _may_be_indented(node) else last
        if word and ends.get(word, 0) <= tree.source.position(node.end)[0]:
            return node.span, f"the heredoc {node.text} is not closed; expected a line '{word}'"
    return None


def _appends(opening: RubyNode, variables: frozenset[str]) -> bool:
    """Return whether `n <<X` appends to a variable: the grammar reads it as a heredoc."""
    line = opening.source.text.rfind("\n", 0, opening.start) + 1
    word = _LAST_WORD.search(opening.source.text[max(line, opening.start - 200) : opening.start])
    return word is not None and (not word[2] or word[1] in variables)


def _variables(nodes: Sequence[RubyNode]) -> frozenset[str]:
    """Return the names that a file assigns, or has as parameters."""
    others = [node for node in nodes if node.type not in _METHODS]
    named = [node.fields.get("left") or node.fields.get("name") for node in others]
    listed = [child for node in nodes if node.type in _PARAMETERS for child in node.children]
    each = [node for node in (*named, *listed) if node is not None and node.type == "identifier"]
    return frozenset(node.text for node in each)


def _may_be_indented(opening: RubyNode) -> bool:
    return opening.text.startswith(("<<-", "<<~"))


def _end_line(node: RubyNode) -> Span | None:
    """Return the line that closes the heredoc of an opening, as the grammar takes it."""
    if node.heredoc is None or not node.heredoc.children:
        return None
    text, at = node.source.text, node.heredoc.children[-1].end - 1
    end = text.find("\n", at)
    return Span(node.source, text.rfind("\n", 0, at) + 1, end if end >= 0 else len(text))


def _closes(line: str, opening: RubyNode) -> bool:
    """Return whether a line is a heredoc end for Ruby; the grammar allows blanks after it."""
    line = line.lstrip() if _may_be_indented(opening) else line
    return line.rstrip("\r") == heredoc_identifier(opening)


def _open_string(tree: RubyNode, nodes: Sequence[RubyNode], first: int) -> SyntaxFault | None:
    """A quote opens a string, and no further quote follows in the file."""
    text = tree.source.text
    if first < len(text) and text[first] in _QUOTES and text[first] not in text[first + 1 :]:
        token = any(
            child.start == first and not child.named
            for node in nodes
            if node.type == "ERROR"
            for child in node.children
        )
        if token:
            message = f"the string is not closed; write {text[first]} at its end"
            return Span(tree.source, first, first + 1), message
    return None


def _side_by_side(_tree: RubyNode, nodes: Sequence[RubyNode], first: int) -> SyntaxFault | None:
    """Two names or numbers in a list with blanks between them: the grammar drops one of them."""
    for node in nodes:
        if node.type in _LISTS and node.broken:
            for one, other in pairwise(node.children):
                values = [
                    each.type == "ERROR" and _VALUE.fullmatch(each.text) for each in (one, other)
                ]
                between = node.source.text[one.end : other.start]
                if (
                    one.named
                    and other.named
                    and any(values)
                    and between.isspace()
                    and first in (one.start, other.start)
                ):
                    return missing_comma(node.source, one.end)
    return None
