"""Syntax errors of a Ruby text, as far as they are certain.

The grammar fails on hardly any valid Ruby, but it does, and it accepts some that Ruby refuses. So a
fault is named only with a proof: something that Ruby never accepts, at a place up to which the
grammar understood everything; or a repair (`ruby_repairs.py`) that makes it understand the whole.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from checker.source.ruby import RubyNode, heredoc_identifier
from checker.source.ruby_repairs import SyntaxFault, innermost, repaired
from checker.source.text import Span

_QUOTES = frozenset({'"', "'"})
_RESERVED = frozenset({"end", "else", "elsif", "then", "when", "ensure"})
_NAMED_SO = frozenset({"method", "singleton_method", "alias", "undef", "keyword_parameter"})
"""Nodes in which a reserved word can be a name."""
_ELSE_NEEDS_RESCUE = frozenset({"begin", "body_statement"})
_PLAIN = frozenset({"identifier", "constant", "string", "integer", "float", "global_variable"})
_LISTS = frozenset({"array", "argument_list", "method_parameters"})
_VALUE = re.compile(r"[\w.]+")
_COMMENT = re.compile(r"^=begin\b(?s:.*?)^=end\b.*|#.*", re.MULTILINE)
_BACKSLASH = re.compile(r"\\(?!\r?\n)")
_OPTIONS = re.compile(r"\W?[imxounse]*")
_GLOBAL = re.compile(r"\$\w+")
_LAST_WORD = re.compile(r"(\w+)([ \t]*)\Z")
_PARAMETERS = frozenset({"method_parameters", "block_parameters"})
_ZEROS = re.compile(r"0_?\d")


def syntax_faults(tree: RubyNode) -> tuple[SyntaxFault, ...]:
    """Return the first certain syntax error of a file, if there is one."""
    nodes = tree.walk()
    errors = _errors(nodes)
    first = min((_place(node) for node in innermost(errors)), default=len(tree.source.text))
    for check in (_open_heredoc, _open_string, _refused, _side_by_side):
        fault = check(tree, nodes, first)
        if fault is not None:
            return (fault,)
    fault = repaired(tree, nodes, errors) if errors else None
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
    """Whether a pattern has options that there are not: it is no pattern, but text or division."""
    return not _OPTIONS.fullmatch(pattern.children[-1].text)


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
            return node.span, f"the heredoc {node.text} is never closed by a line '{word}'"
    return None


def _appends(opening: RubyNode, variables: frozenset[str]) -> bool:
    """Whether `n <<X` appends to a variable: the grammar takes it for a heredoc."""
    line = opening.source.text.rfind("\n", 0, opening.start) + 1
    word = _LAST_WORD.search(opening.source.text[max(line, opening.start - 200) : opening.start])
    return word is not None and (not word[2] or word[1] in variables)


def _variables(nodes: Sequence[RubyNode]) -> frozenset[str]:
    """Return the names that a file assigns, or has as parameters."""
    others = [node for node in nodes if node.type not in _NAMED_SO]
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
    """Whether Ruby takes a line for a heredoc's end; the grammar lets blanks follow the word."""
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
            return Span(tree.source, first, first + 1), "the string is never closed"
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
                    return Span(node.source, one.end - 1, one.end), "a comma is missing behind this"
    return None


# What the grammar accepts, and Ruby does not.


def _refused(tree: RubyNode, nodes: Sequence[RubyNode], first: int) -> SyntaxFault | None:
    faults = [
        *_escaped_blanks(tree, nodes),
        *(fault for node in nodes for judge in _JUDGES for fault in judge(node)),
    ]
    before = [fault for fault in faults if fault[0].end <= first]
    return min(before, key=lambda fault: fault[0].start, default=None)


def _escaped_blanks(tree: RubyNode, nodes: Sequence[RubyNode]) -> Iterator[SyntaxFault]:
    """Yield backslashes between tokens that do not end their line."""
    leaves = sorted((node for node in nodes if not node.children), key=lambda node: node.start)
    at = 0
    for leaf in leaves:
        if at < leaf.start:
            gap = tree.source.text[at : leaf.start]
            if "\\" in gap:
                code = _COMMENT.sub(lambda comment: " " * len(comment.group()), gap)
                for blank in _BACKSLASH.finditer(code):
                    span = Span(tree.source, at + blank.start(), at + blank.end())
                    yield span, "the backslash is not the last character of its line"
        at = max(at, leaf.end)


def _reserved_name(node: RubyNode) -> Iterator[SyntaxFault]:
    if node.type in _NAMED_SO or "receiver" in node.fields:
        return
    for child in node.children:
        if child.type == "identifier" and child.text in _RESERVED:
            yield child.span, f"this {child.text} has nothing to {_belonging(child.text)}"


def _belonging(word: str) -> str:
    return "close" if word == "end" else "belong to"


def _lonely_else(node: RubyNode) -> Iterator[SyntaxFault]:
    kinds = {child.type: child for child in node.children}
    if node.type in _ELSE_NEEDS_RESCUE and "else" in kinds and "rescue" not in kinds:
        opening = kinds["else"].children[:1] or [kinds["else"]]
        yield opening[0].span, "this else has nothing to belong to"


def _missing_comma(node: RubyNode) -> Iterator[SyntaxFault]:
    """Yield elements of a list that are a call without parentheses, which only stands alone."""
    if node.type == "array" or (node.type == "argument_list" and node.text.startswith("(")):
        parts = node.parts
        for part in parts:
            if (end := _end_of_first(part, alone=len(parts) == 1)) is not None:
                yield Span(node.source, end - 1, end), "a comma is missing behind this"


def _end_of_first(part: RubyNode, *, alone: bool) -> int | None:
    """Return the end of the first of two values that only a blank parts."""
    method, arguments = part.fields.get("method"), part.fields.get("arguments")
    if part.type == "element_reference" and len(part.children) > 1:
        value, bracket = part.children[:2]
        return value.end if "\n" in part.source.text[value.end : bracket.start] else None
    if part.type != "call" or method is None or arguments is None or not arguments.parts:
        return None
    first = arguments.parts[0]
    between = part.source.text[method.end : first.start]
    if first.type not in _PLAIN or "(" in between or (alone and "\n" not in between):
        return None
    return method.end


def _strings_of_two_lines(node: RubyNode) -> Iterator[SyntaxFault]:
    """Yield strings that blanks join: Ruby joins those of one line, or behind a backslash."""
    if node.type == "chained_string":
        for one, other in pairwise(node.children):
            between = node.source.text[one.end : other.start]
            if "\n" in between and "\\" not in between:
                yield Span(node.source, one.end - 1, one.end), "a comma is missing behind this"


def _call_of_a_value(node: RubyNode) -> Iterator[SyntaxFault]:
    method = node.fields.get("method")
    if node.type == "call" and method is not None and _GLOBAL.fullmatch(method.text):
        yield method.span, "a variable cannot be called"


def _leading_zeros(node: RubyNode) -> Iterator[SyntaxFault]:
    if node.type == "float" and _ZEROS.match(node.text):
        yield node.span, f"{node.text[:60]} is no number: it starts with 0"


_JUDGES = (
    *(_reserved_name, _lonely_else, _missing_comma),
    *(_strings_of_two_lines, _call_of_a_value, _leading_zeros),
)
