"""Places in a Python text of the nodes of its syntax tree."""

from __future__ import annotations

import ast

from checker.source.text import SourceText, Span


def span_of_node(source: SourceText, node: ast.AST) -> Span:
    """Return the place of a node of the syntax tree."""
    start = _offset(source, getattr(node, "lineno", 1), getattr(node, "col_offset", 0))
    end = _offset(source, getattr(node, "end_lineno", 1), getattr(node, "end_col_offset", 0))
    return Span(source, start, max(start, end))


def _offset(source: SourceText, line: int, column: int) -> int:
    """Return the offset of a line, from 1, and a column in bytes, from 0."""
    start = source.offset_of(line, 1)
    if start is None:
        return len(source.text)
    if column and not source.text.isascii():
        column = len(source.line(line).encode()[:column].decode("utf-8", "ignore"))
    return min(start + column, len(source.text))
