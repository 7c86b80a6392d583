"""Names without the namespace that Gazebo Classic's descriptions put in front of them."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from checker.base.record import Record
from checker.model.robot import Robot

_BLANKS = " \t\r\n"


class Naming(Record):
    """Prefix of the names in the source.

    Attributes:
        prefix: The prefix with its slash; empty for none.
        known: Names of links and joints as the source has them.
    """

    prefix: str
    known: frozenset[str]

    def local(self, name: str) -> str:
        """Return a name without the prefix."""
        return name.removeprefix(self.prefix) if self.prefix else name

    def strip(self, tree: etree._Element) -> None:
        """Remove the prefix from texts and attributes of a copy that name a link or joint."""
        if not self.prefix:
            return
        for node in tree.iter(etree.Element):
            word = (node.text or "").strip(_BLANKS)
            if word in self.known:
                node.text = self.local(word)
            for key, value in node.attrib.items():
                if value in self.known:
                    node.set(key, self.local(value))


def naming_of(robot: Robot, namespace: str = "") -> Naming:
    """Find the prefix of names.

    Args:
        robot: The source.
        namespace: Without the slash; when empty, what all links have in front of a slash.
    """
    links = [link.name.value for link in robot.links]
    known = frozenset((*links, *(joint.name.value for joint in robot.joints)))
    prefix = f"{namespace.rstrip('/')}/" if namespace else _common(links)
    locals_ = {name.removeprefix(prefix) for name in links}
    # Two names that differ by the prefix alone would become one.
    if len(locals_) < len(set(links)) or "" in locals_:
        prefix = ""
    return Naming(prefix, known)


def _common(links: Iterable[str]) -> str:
    """Return what all links but `world` have up to their first slash, or nothing."""
    firsts = {name.partition("/")[0] if "/" in name else "" for name in links if name != "world"}
    return f"{firsts.pop()}/" if len(firsts) == 1 and firsts != {""} else ""
