"""Parameter files of ROS 2: which node each block is for, and what type its values have."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.text import Located, Span

if TYPE_CHECKING:
    from checker.source.yaml import YamlNode

PARAMETERS = "ros__parameters"
MANAGER = "controller_manager"
_DEEPEST = 8
"""Levels of namespaces above a node's parameters."""
_MOST = 5_000
"""Parameters of one node."""
_INT = re.compile(r"[-+]?(?:\d{1,30}|0[xX][0-9a-fA-F]{1,16}|0o?[0-7]{1,22})\Z")
_BOOL = re.compile(r"(?:y|yes|n|no|true|false|on|off)\Z", re.IGNORECASE)
_NUMBER = re.compile(
    r"[-+]?(?:\.?(?:inf|nan)|(?:\d{1,400}\.?\d{0,400}|\.\d{1,400})(?:e[-+]?\d{1,9})?)\Z",
    re.IGNORECASE,
)


class Parameter(Record, eq=False):
    """A parameter of a node.

    Attributes:
        name: The name with dots between its levels: `linear.x.max_velocity`.
        node: Its value.
        key: The place of its name.
    """

    name: str
    node: YamlNode
    key: Span

    @property
    def span(self) -> Span:
        """The value."""
        return self.node.span

    @property
    def type(self) -> str:
        """Type that ROS gives it: `int`, `double_array`, …; empty if unknown."""
        if self.node.kind == "scalar":
            return _type_of(self.node)
        types = {_type_of(item) for item in self.node.items}
        return f"{types.pop()}_array" if len(types) == 1 and "" not in types else ""

    @property
    def texts(self) -> tuple[Located[str], ...]:
        """The text, or the texts of a list; those known at launch only are left out."""
        items = self.node.items if self.node.kind == "sequence" else (self.node,)
        return tuple(
            Located(item.scalar, item.span)
            for item in items
            if isinstance(item.scalar, str) and "$(" not in item.scalar
        )

    @property
    def number(self) -> Located[float] | None:
        """The number; None for anything else."""
        if self.node.kind != "scalar" or self.type not in ("int", "double"):
            return None
        text = self.span.text.lower().replace(".nan", "nan").replace(".inf", "inf")
        try:
            return Located(float(text), self.span)
        except ValueError:  # hexadecimal
            return None

    @property
    def is_known(self) -> bool:
        """True if its value is known before launch."""
        return "$(" not in self.span.text


def _type_of(node: YamlNode) -> str:
    """Return the type of a scalar as rcl's parser sees it, which is not quite that of YAML."""
    text = node.span.text.strip()
    if node.kind != "scalar" or "$(" in text or text.startswith(("*", "&", "!")):
        return ""
    if text.startswith(("'", '"', "|", ">")):
        return "string"
    if _BOOL.match(text):
        return "bool"
    if _INT.match(text):
        return "int"
    return "double" if _NUMBER.match(text) else "string"


class NodeBlock(Record, eq=False):
    """The parameters that a file gives to the nodes of a name.

    Attributes:
        name: Full name that nodes are matched with, with its wildcards: `/**/controller_manager`.
        parameters: The parameters by name, the last one if a name is there twice.
        span: The key above `ros__parameters`.
    """

    name: str
    parameters: Mapping[str, Parameter]
    span: Span

    @property
    def node(self) -> str:
        """Name of the node without its namespace; `**` for every node."""
        return self.name.rpartition("/")[2]

    def is_for(self, node: str, namespace: str) -> bool:
        """Return whether it is for a node of a name in a namespace such as `/robot`."""
        parts = [part for part in (*namespace.split("/"), node) if part]
        reached = {0}
        for wanted in self.name.strip("/").split("/"):
            if wanted == "**":
                reached = set(range(min(reached, default=len(parts)), len(parts) + 1))
            else:
                reached = {
                    at + 1 for at in reached if at < len(parts) and wanted in ("*", parts[at])
                }
        return len(parts) in reached


def unread_blocks(
    blocks: Iterable[NodeBlock], namespace: str, names: Collection[str]
) -> list[NodeBlock]:
    """Return the blocks for nodes of some names, where none of a name is for its namespace.

    Args:
        blocks: The blocks of one file.
        namespace: The namespace in which the nodes run.
        names: The names of the nodes, without namespace.
    """
    own = [block for block in blocks if block.node in names]
    read = {block.node for block in own if block.is_for(block.node, namespace)}
    return [it for it in own if it.node not in read and "$(" not in it.name + namespace]


def read_blocks(root: YamlNode) -> Iterator[NodeBlock]:
    """Yield the blocks of a parameter file, in order."""
    waiting: list[tuple[YamlNode, str, Span]] = [(root, "", root.span)]
    while waiting:
        node, above, span = waiting.pop()
        own = node.get(PARAMETERS)
        if own is not None and above:
            yield NodeBlock(above, dict(flat_parameters(own)), span)
        below = [
            (value, f"{above}/{name.strip('/')}", key.span)
            for key, value in node.entries
            if value.kind == "mapping" and (name := key_name(key)) not in ("", PARAMETERS)
        ]
        if above.count("/") < _DEEPEST:
            waiting += reversed(below)


def bare_managers(root: YamlNode) -> Iterator[Span]:
    """Yield the keys of controller managers below which `ros__parameters` is missing."""
    waiting = [(root, 0)]
    while waiting:
        node, depth = waiting.pop()
        for key, value in node.entries:
            name = key_name(key).rpartition("/")[2]
            if value.kind != "mapping" or name == PARAMETERS:
                continue
            if name != MANAGER and depth < _DEEPEST:
                waiting.append((value, depth + 1))
            elif name == MANAGER and value.get(PARAMETERS) is None:
                yield key.span


def refused_value(root: YamlNode) -> Span | None:
    """Return the first place for which rcl refuses a whole file: a value of no node; else None."""
    if root.kind != "mapping":
        return root.span
    waiting = [(key, value, False) for key, value in reversed(root.entries)]
    while waiting:
        key, value, below = waiting.pop()
        if value.kind != "mapping" or (key_name(key) == PARAMETERS and not below):
            return key.span
        inner = [it for it in value.entries if key_name(it[0]) != PARAMETERS]
        waiting += [(key, value, True) for key, value in reversed(inner)]
    return None


def key_name(key: YamlNode) -> str:
    """Return the text of a key; empty for one that is none."""
    return str(key.scalar)[:300] if key.kind == "scalar" and key.scalar is not None else ""


def flat_parameters(root: YamlNode) -> Iterator[tuple[str, Parameter]]:
    """Yield what is at the ends of nested mappings, under names with dots."""
    waiting: list[tuple[YamlNode, str]] = [(root, "")]
    count = 0
    while waiting and count < _MOST:
        node, above = waiting.pop()
        for key, value in node.entries:
            name = f"{above}{key_name(key)}"
            count += 1
            if value.kind == "mapping":
                waiting.append((value, f"{name}."))
            else:
                yield name, Parameter(name, value, key.span)
