"""Values in Python that are computed and not used."""

from __future__ import annotations

import ast
from collections.abc import Iterator

_LIMIT = 200_000
"""Characters of a text, at most; longer ones stay as they are."""


def without_unused_values(text: str) -> str:
    """Return Python without the statements that set local variables that nothing reads.

    Other texts, and those that cannot be parsed, stay as they are.
    """
    if len(text) > _LIMIT or "def " not in text:
        return text
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return text
    lines = text.splitlines(keepends=True)
    for statement in _unused(tree):
        for number in range(statement.lineno, (statement.end_lineno or statement.lineno) + 1):
            lines[number - 1] = "\n"
    return "".join(lines)


def _unused(tree: ast.Module) -> Iterator[ast.Assign]:
    nodes = [*ast.walk(tree)]
    read = {it.id for it in nodes if isinstance(it, ast.Name) and isinstance(it.ctx, ast.Load)}
    if "locals" in read:
        return
    functions = (it for it in nodes if isinstance(it, ast.FunctionDef))
    for statement in (part for function in functions for part in function.body):
        if isinstance(statement, ast.Assign):
            names = [it.id for it in statement.targets if isinstance(it, ast.Name)]
            if len(names) == len(statement.targets) and read.isdisjoint(names):
                yield statement
