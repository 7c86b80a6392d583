"""Ruby with places: tree-sitter's tree as plain nodes that know their characters.

Each node stands by itself (type, children, fields, character offsets), comments are left out,
and every heredoc's opening (`<<~XML`) is joined to its body.
"""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import accumulate
from typing import TYPE_CHECKING

from checker.source.text import SourceText, Span

if TYPE_CHECKING:
    import tree_sitter


MAX_SECONDS = 0.3
"""Processor time of one parse; real spawners take 5 ms.

For every literal that is never closed, the parser looks through the rest of the text: 100 kB of
them take it half a minute."""
_CHUNK = 4096
_LEFT_OUT = frozenset({"comment", "heredoc_body", "empty_statement", "uninterpreted"})


class ParsesTooSlowly(Exception):
    """A text takes more than `MAX_SECONDS` to parse."""


@dataclass(eq=False, slots=True)
class RubyNode:
    """One node of the syntax tree.

    Attributes:
        source: The text it stands in.
        type: Name in the grammar of tree-sitter-ruby, or the token itself (`"end"`).
        named: False for bare tokens such as keywords and brackets.
        start: Offset of the first character.
        end: Offset behind the last character.
        missing: The parser made it up to go on.
        broken: A direct child is made up or could not be parsed.
        children: All children in order, without comments.
        fields: Children by their field's name.
        heredoc: The body, at a heredoc's opening.
    """

    source: SourceText
    type: str
    named: bool
    start: int
    end: int
    missing: bool = False
    broken: bool = False
    children: list[RubyNode] = field(default_factory=list)
    fields: dict[str, RubyNode] = field(default_factory=dict)
    heredoc: RubyNode | None = None

    @property
    def text(self) -> str:
        """The characters of the node."""
        return self.source.text[self.start : self.end]

    @property
    def span(self) -> Span:
        """The place of the node."""
        return Span(self.source, self.start, self.end)

    @property
    def parts(self) -> list[RubyNode]:
        """Named children: statements, arguments, elements."""
        return [node for node in self.children if node.named and node.type not in _LEFT_OUT]

    def walk(self) -> list[RubyNode]:
        """Return the node and all below it, in document order."""
        nodes, waiting = [], [self]
        while waiting:
            node = waiting.pop()
            nodes.append(node)
            waiting.extend(reversed(node.children))
        return nodes


def parse_ruby(source: SourceText) -> RubyNode:
    """Parse a Ruby text; what the grammar cannot parse becomes nodes of the type `ERROR`.

    Raises:
        ParsesTooSlowly: It takes too long.
    """
    tree = _tree(source.text.encode("utf-8"))
    to_chars = _byte_to_char(source.text)
    cursor = tree.walk()
    path: list[RubyNode] = []
    while (raw := cursor.node) is not None:
        node = RubyNode(
            source,
            raw.type,
            raw.is_named,
            to_chars(raw.start_byte),
            to_chars(raw.end_byte),
            raw.is_missing,
        )
        if path and node.type != "comment":
            _attach(path[-1], node, cursor.field_name)
        path.append(node)
        if cursor.goto_first_child():
            continue
        while not cursor.goto_next_sibling():
            if not cursor.goto_parent():
                _join_heredocs(path[0])
                return path[0]
            path.pop()
        path.pop()
    raise AssertionError("a cursor always stands on a node")


def _tree(text: bytes) -> tree_sitter.Tree:
    import tree_sitter
    import tree_sitter_ruby

    end = time.thread_time() + MAX_SECONDS
    parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_ruby.language()))
    try:
        return parser.parse(
            # It asks how it goes on only of a text that it reads in parts.
            lambda at, _position: text[at : at + _CHUNK],
            progress_callback=lambda *_progress: time.thread_time() > end,
        )
    except ValueError:  # it was stopped
        raise ParsesTooSlowly from None


def _attach(parent: RubyNode, node: RubyNode, field_name: str | None) -> None:
    parent.children.append(node)
    if node.missing or node.type == "ERROR":
        parent.broken = True
    if field_name is not None:
        parent.fields.setdefault(field_name, node)


def _join_heredocs(root: RubyNode) -> None:
    """Give each heredoc's opening its body: bodies follow in the order of the openings.

    The grammar misplaces the body of a heredoc that is opened inside another one's body, so
    such an opening gets none.
    """
    waiting: list[RubyNode] = []
    inside = 0
    for node in root.walk():
        if node.type == "heredoc_beginning" and node.start >= inside:
            waiting.append(node)
        elif node.type == "heredoc_body" and waiting:
            inside = max(inside, node.end)
            end = node.children[-1].text.strip() if node.children else ""
            if end == heredoc_identifier(waiting[0]):
                waiting.pop(0).heredoc = node


def heredoc_identifier(opening: RubyNode) -> str:
    """Return the word that ends a heredoc: `XML` for `<<~'XML'`."""
    return opening.text.lstrip("<-~").strip("\"'`")


def _byte_to_char(text: str) -> Callable[[int], int]:
    """Return the map from offsets in the UTF-8 bytes to offsets in the text."""
    if text.isascii():
        return lambda offset: offset
    wide = [(at, len(char.encode("utf-8")) - 1) for at, char in enumerate(text) if char > "\x7f"]
    extra = [0, *accumulate(more for _, more in wide)]
    first_byte_after = [at + 1 + extra[i + 1] for i, (at, _) in enumerate(wide)]
    return lambda offset: offset - extra[bisect_right(first_byte_after, offset)]


# Syntax errors that are certain.
#
# The grammar also fails on some valid Ruby, so only what cannot be anything else is named here:
# the first fault of a file, at a place up to which everything was understood.


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
            return node.span, "this end has nothing to close"
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
