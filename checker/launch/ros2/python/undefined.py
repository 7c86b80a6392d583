"""Names that a launch file in Python uses and that nothing defines."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator

from checker.launch.ros2.python.unbound import UnboundName, unbound_names

_GIVEN = frozenset({*dir(builtins), "__file__", "__path__"})
"""Names that every module has."""
_ANY_NAME = frozenset({"exec", "globals", "locals", "vars", "setattr"})
"""Functions that may define names."""
_Function = ast.FunctionDef | ast.AsyncFunctionDef


def undefined_names(tree: ast.Module, entry: str) -> list[UnboundName]:
    """Return the first use of each name that Python cannot find when the file is launched.

    A name that is bound anywhere in the file counts as defined, whatever the order, except a local
    name in its function. What is in a `try`, and functions that nothing names, are not read.

    Args:
        tree: The tree of the file.
        entry: Name of the function that launch calls.
    """
    bound = {*_GIVEN, *_bound(tree)}
    late: list[UnboundName] = []
    functions = {node.name: node for node in ast.walk(tree) if isinstance(node, _Function)}
    first: dict[str, ast.Name] = {}
    waiting: list[ast.AST] = [tree, *filter(None, [functions.pop(entry, None)])]
    while waiting:
        node = waiting.pop()
        late += unbound_names(node)
        for name in _used(node):
            if name.id in _ANY_NAME:
                return []
            if name.id not in bound and "*" not in bound:
                first.setdefault(name.id, name)
            elif name.id in functions:
                waiting.append(functions.pop(name.id))
    return [*map(UnboundName, first.values()), *late]


def _used(node: ast.AST) -> Iterator[ast.Name]:
    """Yield the names that a module or function reads; functions within it are not entered."""
    parts = node.body if isinstance(node, _Function) else ast.iter_child_nodes(node)
    for inner in parts:
        if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Load):
            yield inner
        elif isinstance(inner, _Function):
            for decorator in inner.decorator_list:
                yield from _used(decorator)
        elif not isinstance(inner, ast.Try | ast.ClassDef) and not _is_annotation(inner):
            yield from _used(inner)


def _is_annotation(node: ast.AST) -> bool:
    """Return whether Python may not evaluate a node."""
    return isinstance(node, ast.AnnAssign | ast.arg)


def _bound(tree: ast.Module) -> Iterator[str]:
    """Yield the names that any statement of a file binds; `*` where these are unknown."""
    for node in ast.walk(tree):
        match node:
            case ast.Name(ctx=ast.Store() | ast.Del()):
                yield node.id
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                yield node.name
            case ast.arg():
                yield node.arg
            case ast.alias():
                yield (node.asname or node.name).partition(".")[0]
            case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
                yield name
            case ast.MatchStar(name=str(name)) | ast.MatchMapping(rest=str(name)):
                yield name
