"""The tree of a robot's links, each below the joint that connects it with its parent."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.editor.names.outline.symbol import Symbol

DEPTH_LIMIT = 60
"""Links below each other; one that is deeper starts its own tree."""


class JointSymbol(Record):
    """A joint, and the names of the links that it connects."""

    symbol: Symbol
    parent: str
    child: str


def link_tree(links: Sequence[Symbol], joints: Sequence[JointSymbol]) -> tuple[Symbol, ...]:
    """Return the links that nothing carries, with all that they carry; each link and joint once.

    A joint without a known parent is next to them. Links that carry each other in a loop begin
    with the one that the file names first; of two links with one name, the first is meant.
    """
    return _Tree(links, joints).symbols()


class _Tree:
    def __init__(self, links: Sequence[Symbol], joints: Sequence[JointSymbol]) -> None:
        self._links = links
        self._joints = joints
        self._first: dict[str, int] = {}
        for number, link in enumerate(links):
            self._first.setdefault(link.name, number)
        self._below: dict[int, list[int]] = defaultdict(list)
        for number, joint in enumerate(joints):
            if joint.parent in self._first:
                self._below[self._first[joint.parent]].append(number)
        self._placed: set[int] = set()

    def symbols(self) -> tuple[Symbol, ...]:
        """Return the outermost symbols in the order of the file."""
        carried = {self._first.get(joint.child) for joint in self._joints}
        loose = [it for it in self._joints if it.parent not in self._first]
        numbers = range(len(self._links))
        found = [self._link(it, 0) for it in numbers if it not in carried]
        found += [self._joint(joint, 0) for joint in loose]
        for it in numbers:
            if it not in self._placed:
                found.append(self._link(it, 0))
        return tuple(sorted(found, key=lambda it: it.start))

    def _link(self, number: int, depth: int) -> Symbol:
        self._placed.add(number)
        link = self._links[number]
        joints = (self._joint(self._joints[it], depth + 1) for it in self._below[number])
        return replace(link, children=(*link.children, *joints))

    def _joint(self, joint: JointSymbol, depth: int) -> Symbol:
        child = self._first.get(joint.child)
        if child is None or child in self._placed or depth > DEPTH_LIMIT:
            return joint.symbol
        below = self._link(child, depth)
        return replace(joint.symbol, children=(*joint.symbol.children, below))
