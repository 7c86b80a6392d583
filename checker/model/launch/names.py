"""Names of the ROS graph: how a relative, private or absolute name becomes absolute."""

from __future__ import annotations


def resolve_name(name: str, namespace: str, node: str = "") -> str:
    """Return the absolute form of a name.

    Args:
        name: Absolute (`/a`), relative (`a`) or private (`~a`).
        namespace: Absolute namespace of the node or group.
        node: Name of the node, for private names.
    """
    if name.startswith("/"):
        parts = name.split("/")
    elif name.startswith("~"):
        parts = [*namespace.split("/"), node, *name[1:].split("/")]
    else:
        parts = [*namespace.split("/"), *name.split("/")]
    return "/" + "/".join(part for part in parts if part)
