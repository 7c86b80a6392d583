"""Code that the grammar of Ruby accepts, and Ruby itself does not."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from checker.source.ruby import RubyNode
from checker.source.ruby_repairs import SyntaxFault, missing_comma, unexpected
from checker.source.text import Span

_RESERVED = frozenset({"end", "do", "else", "elsif", "then", "when", "ensure"})
_NAMED_SO = frozenset({"method", "singleton_method", "alias", "undef", "keyword_parameter"})
"""Nodes in which a reserved word can be a name."""
_ELSE_NEEDS_RESCUE = frozenset({"begin", "body_statement"})
_PLAIN = frozenset({"identifier", "constant", "string", "integer", "float", "global_variable"})
_ASSIGNMENTS = frozenset({"assignment", "operator_assignment"})
_COMMENT = re.compile(r"^=begin\b(?s:.*?)^=end\b.*|#.*", re.MULTILINE)
_BACKSLASH = re.compile(r"\\(?!\r?\n)")
_GLOBAL = re.compile(r"\$\w+")
_ZEROS = re.compile(r"0_?\d")


def first_refusal(tree: RubyNode, nodes: Sequence[RubyNode], first: int) -> SyntaxFault | None:
    """Return the first thing that Ruby refuses.

    Args:
        tree: The tree of a file.
        nodes: All its nodes, in order.
        first: Offset up to which the grammar understood everything.
    """
    faults = [
        *_escaped_blanks(tree, nodes),
        *_constants_in_methods(nodes),
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


def _constants_in_methods(nodes: Sequence[RubyNode]) -> Iterator[SyntaxFault]:
    end = 0
    for node in nodes:
        if node.type == "method":
            end = max(end, node.end)
        left = node.fields.get("left") if node.type in _ASSIGNMENTS else None
        if left is not None and left.type == "constant" and node.start < end:
            yield left.span, f"the constant {left.text[:60]} cannot be set in a method"


def _reserved_name(node: RubyNode) -> Iterator[SyntaxFault]:
    if node.type in _NAMED_SO or "receiver" in node.fields:
        return
    for child in node.children:
        if child.type == "identifier" and child.text in _RESERVED:
            yield unexpected(child)


def _lonely_else(node: RubyNode) -> Iterator[SyntaxFault]:
    kinds = {child.type: child for child in node.children}
    if node.type in _ELSE_NEEDS_RESCUE and "else" in kinds and "rescue" not in kinds:
        opening = kinds["else"].children[:1] or [kinds["else"]]
        yield opening[0].span, "unexpected else: the block has no rescue"


def _missing_comma(node: RubyNode) -> Iterator[SyntaxFault]:
    """Yield elements of a list that are a call without parentheses, which only stands alone."""
    if node.type == "array" or (node.type == "argument_list" and _has_parentheses(node)):
        parts = node.parts
        for part in parts:
            if (end := _end_of_first(part, alone=len(parts) == 1)) is not None:
                yield missing_comma(node.source, end)


def _has_parentheses(arguments: RubyNode) -> bool:
    return bool(arguments.children) and arguments.children[0].type == "("


def _end_of_first(part: RubyNode, *, alone: bool) -> int | None:
    """Return the end of the first of two values that only a blank separates."""
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
                yield missing_comma(node.source, one.end)


def _call_of_a_value(node: RubyNode) -> Iterator[SyntaxFault]:
    method = node.fields.get("method")
    if node.type == "call" and method is not None and _GLOBAL.fullmatch(method.text):
        yield method.span, f"the variable {method.text[:60]} cannot be called with arguments"


def _leading_zeros(node: RubyNode) -> Iterator[SyntaxFault]:
    if node.type == "float" and _ZEROS.match(node.text):
        yield node.span, f"{node.text[:60]} is not a number: it starts with 0"


_JUDGES = (
    *(_reserved_name, _lonely_else, _missing_comma),
    *(_strings_of_two_lines, _call_of_a_value, _leading_zeros),
)
