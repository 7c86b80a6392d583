"""The outline of one file of any format."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from checker.editor.names.outline.robot_symbols import sdf_symbols, urdf_symbols
from checker.editor.names.outline.symbol import Symbol, SymbolKind, element_symbol
from checker.launch.ros2.python.launch_file import parse_source
from checker.package.package import Package
from checker.source.python_places import span_of_node
from checker.source.ruby import ParsesTooSlowly, RubyNode, parse_ruby
from checker.source.text import SourceText
from checker.source.xml import Element, XmlDocument
from checker.source.yaml import YamlNode, read_yaml

_LEVELS = 2
"""Levels of keys of a YAML file that are shown."""
_YAML = (".yaml", ".yml", ".rviz")
_OF_LAUNCH = {
    "arg": SymbolKind.ARGUMENT,
    "let": SymbolKind.ARGUMENT,
    "node": SymbolKind.NODE,
    "composable_node": SymbolKind.NODE,
    "include": SymbolKind.INCLUDE,
}


def symbols_of(package: Package, path: str) -> tuple[Symbol, ...]:
    """Return the outline of a file; nothing for a file that cannot be read or has none.

    Args:
        package: The package that contains the file.
        path: The path of the file, relative to the package.
    """
    source = package.read(path)
    if not isinstance(source, SourceText):
        return ()
    lower = path.lower()
    if lower.endswith(_YAML):
        root = read_yaml(source).root
        return tuple(_of_yaml(root, _LEVELS)) if root is not None else ()
    if lower.endswith(".rb"):
        return tuple(_of_ruby(source))
    if lower.endswith(".py"):
        return tuple(_of_python(source))
    document = package.xml(path)
    return _of_xml(document.root) if isinstance(document, XmlDocument) else ()


def _of_xml(root: Element) -> tuple[Symbol, ...]:
    if root.tag == "sdf":
        return sdf_symbols(root)
    if root.tag == "robot":
        return urdf_symbols(root)
    return tuple(_of_launch(root)) if root.tag == "launch" else ()


def _of_launch(root: Element) -> Iterator[Symbol]:
    for element in root.descendants():
        kind = _OF_LAUNCH.get(element.tag)
        above = element.parent
        if kind is None or (above is not None and above.tag == "include"):
            continue
        if kind is SymbolKind.INCLUDE:
            yield element_symbol(element, kind, attribute="file")
        elif kind is SymbolKind.NODE:
            program = element.get("exec") or element.get("type") or element.get("plugin") or ""
            detail = "/".join(filter(None, (element.get("pkg"), program)))
            attribute = "name" if element.get("name") else "exec"
            yield element_symbol(element, kind, (), detail, attribute)
        else:
            detail = element.get("default") or element.get("value") or ""
            yield element_symbol(element, kind, (), detail)


def _of_yaml(node: YamlNode, levels: int) -> Iterator[Symbol]:
    """Yield the keys of a mapping; of a list, its items by their first value."""
    if levels == 0:
        return
    for key, value in node.entries:
        if key.kind == "scalar":
            inside = tuple(_of_yaml(value, levels - 1)) if value.kind == "mapping" else ()
            end = max(value.span.end, key.span.end)
            yield _key(key, key.span.start, end, inside)
    for item in node.items:
        if item.kind == "mapping" and item.entries:
            first = item.entries[0][1]
            shown = first if first.kind == "scalar" else item.entries[0][0]
            yield _key(shown, item.span.start, item.span.end, tuple(_of_yaml(item, levels - 1)))


def _key(node: YamlNode, start: int, end: int, children: tuple[Symbol, ...]) -> Symbol:
    span = node.span
    name = str(node.scalar) if node.scalar is not None else span.text
    return Symbol(name or "?", SymbolKind.KEY, start, end, span.start, span.end, children)


def _of_ruby(source: SourceText) -> Iterator[Symbol]:
    try:
        nodes = parse_ruby(source).walk()
    except ParsesTooSlowly:
        return
    for node in nodes:
        name: RubyNode | None = node.fields.get("name")
        if node.type in ("method", "singleton_method") and name is not None and name.text:
            kind = SymbolKind.FUNCTION
            yield Symbol(name.text, kind, node.start, node.end, name.start, name.end)


def _of_python(source: SourceText) -> Iterator[Symbol]:
    tree = parse_source(source)
    if isinstance(tree, str):
        return
    yield from _functions(tree, source)


def _functions(tree: ast.AST, source: SourceText) -> Iterator[Symbol]:
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            continue
        is_class = isinstance(node, ast.ClassDef)
        span = span_of_node(source, node)
        start, end = span.start, span.end
        at = source.text.find(node.name, start, end)
        place = (at, at + len(node.name)) if at >= 0 else (start, start)
        inside = tuple(_functions(node, source)) if is_class else ()
        kind = SymbolKind.CLASS if is_class else SymbolKind.FUNCTION
        yield Symbol(node.name, kind, start, end, *place, inside)
