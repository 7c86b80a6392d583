"""Ruby with places: tree-sitter's tree as plain nodes with their offsets.

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
        source: The text that contains it.
        type: Name in the grammar of tree-sitter-ruby, or the token itself (`"end"`).
        named: False for bare tokens such as keywords and brackets.
        start: Offset of the first character.
        end: Offset behind the last character.
        missing: The parser inserted it to continue.
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
    tree = _tree(source.text.encode("utf-8"), time.thread_time() + MAX_SECONDS)
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


def is_understood(text: str, until: float) -> bool:
    """Return whether the grammar understands a whole text.

    Args:
        text: The text of a Ruby file.
        until: Processor time of the thread at which to give up.

    Raises:
        ParsesTooSlowly: It is not known by then.
    """
    return not _tree(text.encode("utf-8"), until).root_node.has_error


def _tree(text: bytes, end: float) -> tree_sitter.Tree:
    import tree_sitter
    import tree_sitter_ruby

    parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_ruby.language()))
    try:
        return parser.parse(
            # It only asks for the rest of a text that it reads in parts.
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
