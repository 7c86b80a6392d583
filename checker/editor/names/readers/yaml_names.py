"""Names in YAML: controllers, bridges, parameters of nodes, and RViz's settings."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from checker.editor.names.mention import ANY_PART, Role, WrittenName
from checker.editor.names.readers.launch_names import ARGUMENT, named_arguments
from checker.editor.names.readers.values import names_in
from checker.source.text import Span
from checker.source.yaml import YamlNode

_KEYED = ("gains", "constraints", "joint", "initial_positions", "Frames", "Links", "Tree")
"""Words of keys below which keys are names of joints or frames."""
_COMMANDS = frozenset({"args", "cmd", "arguments", "ros_arguments"})


def yaml_names(root: YamlNode) -> Iterator[WrittenName]:
    """Yield the names of a YAML file."""
    is_launch = root.kind == "mapping" and root.get("launch") is not None
    waiting: list[tuple[YamlNode, str, YamlNode | None]] = [(root, "", None)]
    seen: set[int] = set()
    while waiting:
        node, key, above = waiting.pop()
        if node.span.start in seen and node.kind == "scalar":
            continue  # an alias of what was read where it was written
        seen.add(node.span.start)
        if node.kind == "scalar":
            yield from _value(node, key, is_launch)
        waiting += [(item, key, above) for item in node.items]
        for name, value in node.entries:
            word = str(name.scalar)
            if any(part in key for part in _KEYED) or "." in word:
                yield from _key(name, word)
            inner = key if name.kind != "scalar" or word in ("Value", "value", "default") else word
            if word in ("value", "default") and (named := node.get("name")) is not None:
                inner = str(named.scalar)
            if is_launch and word == "name" and key in ("arg", "let"):
                yield from _argument(value, above)
            waiting.append((value, inner, node if word == "include" else above))


def text_of(node: YamlNode) -> Span | None:
    """Return the place of a scalar's text without its quotes; None if it is escaped."""
    span = node.span
    text = span.text
    if text[:1] in ("'", '"') and len(text) > 1 and text[-1:] == text[:1]:
        span = Span(span.source, span.start + 1, span.end - 1)
    return span if isinstance(node.scalar, str) and span.text == node.scalar else None


def _value(node: YamlNode, key: str, is_launch: bool) -> Iterator[WrittenName]:
    span = text_of(node)
    if span is None or not span.text:
        return
    yield from names_in(span.text, span.start, key, words=key in _COMMANDS)
    if is_launch:
        yield from named_arguments(span.text, span.start)


def _key(name: YamlNode, word: str) -> Iterator[WrittenName]:
    """Yield what a key may name as a whole, or as a step of `gains.left_joint.p`."""
    span = text_of(name)
    if span is None:
        return
    kinds = ANY_PART
    yield WrittenName(kinds, word, span.start, span.end, Role.MAY_NAME)
    steps = word.split(".")
    at = span.start
    for number, step in enumerate(steps):
        if number and steps[number - 1] in ("gains", "constraints"):
            yield WrittenName(kinds, step, at, at + len(step), Role.MAY_NAME)
        at += len(step) + 1


def _argument(value: YamlNode, include: YamlNode | None) -> Iterator[WrittenName]:
    """Yield an argument of a launch file: declared, or passed to a file that is included."""
    span = text_of(value)
    if span is None:
        return
    held = include.get("include") if include is not None else None
    file = held.get("file") if held is not None and held.kind == "mapping" else None
    files = (posixpath.basename(str(file.scalar)),) if file is not None else ()
    role = Role.MAY_NAME if files else Role.DEFINES
    yield WrittenName(ARGUMENT, span.text, span.start, span.end, role, files)
