"""Local names that a function of a launch file uses above the statement that first binds them."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from checker.base.record import Record

_Function = ast.FunctionDef | ast.AsyncFunctionDef


class UnboundName(Record, eq=False):
    """A name that Python cannot find where it is used.

    Attributes:
        use: The first use.
        bound_in_line: The line below that binds it in the same function; 0 if none does.
    """

    use: ast.Name
    bound_in_line: int = 0


class _Event(Record, eq=False):
    """A name that is read or bound, in the order in which Python does so.

    Attributes:
        name: The name.
        line: The line of it.
        use: The node that reads it; None if it is bound.
        loops: The loops around it.
    """

    name: str
    line: int
    use: ast.Name | None
    loops: tuple[ast.AST, ...]


def unbound_names(function: ast.AST) -> Iterator[UnboundName]:
    """Yield the names that are certainly unbound where a function first reads them.

    What is in a `try` may be meant to fail; in a loop, an earlier round may have bound the name.
    """
    if not isinstance(function, _Function):
        return
    seen = {node.arg for node in ast.walk(function.args) if isinstance(node, ast.arg)}
    events = [*_of_all(function.body, ())]
    bindings: dict[str, list[_Event]] = {}
    for event in events:
        if event.use is None:
            bindings.setdefault(event.name, []).append(event)
    for event in events:
        later = bindings.get(event.name, [])
        if event.name not in seen and event.use is not None and later:
            loops = {loop for binding in later for loop in binding.loops}
            if not loops & {*event.loops}:
                yield UnboundName(event.use, later[0].line)
        seen.add(event.name)


def _of_all(nodes: Iterable[ast.AST | None], loops: tuple[ast.AST, ...]) -> Iterator[_Event]:
    for node in nodes:
        if node is not None:
            yield from _events(node, loops)


def _events(node: ast.AST, loops: tuple[ast.AST, ...]) -> Iterator[_Event]:
    """Yield what a node reads and binds; functions within it run later, and are not entered."""
    match node:
        case ast.Name():
            use = node if isinstance(node.ctx, ast.Load) else None
            yield _Event(node.id, node.lineno, use, loops)
        case ast.AugAssign(target=ast.Name() as name):
            yield _Event(name.id, name.lineno, name, loops)
            yield from _of_all((node.value, name), loops)
        case ast.Assign():
            yield from _of_all((node.value, *node.targets), loops)
        case ast.AnnAssign() | ast.NamedExpr():
            yield from _of_all((node.value, node.target), loops)
        case ast.For() | ast.AsyncFor() | ast.While():
            yield from _of_all(ast.iter_child_nodes(node), (*loops, node))
        case ast.ListComp() | ast.SetComp() | ast.DictComp():
            results = [it for it in ast.iter_child_nodes(node) if it not in node.generators]
            own = {name for each in node.generators for name in _names(each.target)}
            inner = _of_all((*node.generators, *results), loops)
            yield from (event for event in inner if event.name not in own)
        case ast.Try() | ast.TryStar():
            inner = _of_all(ast.iter_child_nodes(node), loops)
            yield from (event for event in inner if event.use is None)
        case ast.Lambda() | ast.GeneratorExp():
            return
        case _:
            yield from (_Event(name, _line(node), None, loops) for name in _bound_by(node))
            if not isinstance(node, _Function | ast.ClassDef):
                yield from _of_all(ast.iter_child_nodes(node), loops)


def _bound_by(node: ast.AST) -> Iterator[str]:
    """Yield the names that a node binds by itself, or that are not local because of it."""
    match node:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            yield node.name
        case ast.alias():
            yield (node.asname or node.name).partition(".")[0]
        case ast.Global() | ast.Nonlocal():
            yield from node.names
        case ast.ExceptHandler(name=str(name)) | ast.MatchAs(name=str(name)):
            yield name
        case ast.MatchStar(name=str(name)) | ast.MatchMapping(rest=str(name)):
            yield name


def _names(node: ast.AST) -> Iterator[str]:
    return (inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name))


def _line(node: ast.AST) -> int:
    return int(getattr(node, "lineno", 0))
