"""Launch files of the challenge's own package, which no submission contains: the nodes they start.

The table `models_common` has the assumptions about each, and their sources.
"""

from __future__ import annotations

import posixpath
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from checker.base.resources import table
from checker.launch.ros1.bridge import Bridge, read_bridges
from checker.launch.ros1.graph import Node, Remap, UnresolvedInclude
from checker.source.text import Located

FOLDER = "launch/models_common"
PACKAGE = "subt_ros"
MAX_LENGTH = 2_000
"""Characters of an arg; a longer one names no topic."""


def assumed_nodes(
    include: UnresolvedInclude, remaps: Sequence[Remap] = ()
) -> tuple[Node, ...] | None:
    """Return the nodes that an included template starts; None if it is not known.

    Args:
        include: The include of the unavailable file.
        remaps: The remaps in force where it is included, in order of the file.
    """
    template = _template(include)
    if template is None:
        return None
    values = _values(template, include)
    if any(value is None or len(value) > MAX_LENGTH for value in values.values()):
        return None
    around = tuple(replace(remap, inherited=True) for remap in reversed(remaps))
    return tuple(_node(entry, values, include, around) for entry in template["nodes"])


def unknown_nodes(include: UnresolvedInclude) -> Hashable:
    """Return what distinguishes the nodes of a template that starts some with unknown names.

    Two includes with the same answer start nodes of the same names; None if they are known.
    """
    template = _template(include)
    if template is None or template["nodes"]:
        return None
    return include.file, include.namespace, tuple(_values(template, include).items())


def _template(include: UnresolvedInclude) -> Mapping[str, Any] | None:
    folder, file = posixpath.split(include.file)
    template: Mapping[str, Any] | None = table("models_common")["templates"].get(file)
    return template if (include.package, folder) == (PACKAGE, FOLDER) else None


def _values(template: Mapping[str, Any], include: UnresolvedInclude) -> dict[str, Any]:
    return {
        name: include.arguments.get(name, default) for name, default in template["args"].items()
    }


def assumed_bridges(node: Node) -> tuple[Bridge, ...]:
    """Return what an assumed node passes between Gazebo and ROS."""
    words = [Located(word, node.span) for word in node.args.split()]
    return tuple(read for read in read_bridges(node, words) if isinstance(read, Bridge))


def _node(
    entry: Mapping[str, Any],
    values: Mapping[str, str],
    include: UnresolvedInclude,
    around: tuple[Remap, ...],
) -> Node:
    own = (
        Remap(_filled(source, values), _filled(target, values), include.span)
        for source, target in entry.get("remaps", ())
    )
    return Node(
        entry["pkg"],
        entry["type"],
        _filled(entry["name"], values),
        include.namespace,
        _filled(entry.get("args", ""), values),
        (*own, *around),
        include.span,
        assumed_from=posixpath.basename(include.file),
        usual=entry.get("usual", False),
    )


def _filled(text: str, values: Mapping[str, str]) -> str:
    # Not str.format: what a user wrote may hold braces.
    for name, value in values.items():
        text = text.replace(f"{{{name}}}", value)
    return text
