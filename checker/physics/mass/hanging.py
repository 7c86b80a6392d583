"""Which link hangs on which when each hangs on one other at most, as a tree of bodies needs it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from checker.base.record import Record
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie


class Hanging(Record, eq=False):
    """The links of a robot, parents before children.

    Attributes:
        order: Scoped names, each behind the one it hangs on.
        by: The tie by which a link hangs, by the link; roots have none.
        left_out: Ties whose child hangs on another link already.
    """

    order: tuple[str, ...]
    by: dict[str, Tie]
    left_out: tuple[Tie, ...]

    @property
    def depth_first(self) -> Iterator[str]:
        """The links so that all that hangs on one follows it without a gap."""
        below: dict[str | None, list[str]] = {}
        for name in self.order:
            tie = self.by.get(name)
            below.setdefault(tie.parent if tie is not None else None, []).append(name)
        waiting = [*reversed(below.get(WORLD, [])), *reversed(below.get(None, []))]
        while waiting:
            name = waiting.pop()
            yield name
            waiting.extend(reversed(below.get(name, [])))


def hang(robot: Robot) -> Hanging:
    """Let each link hang by its first tie; a circle opens above its link that stands first."""
    tree = robot.tree
    by = {name: ties[0] for name, ties in tree.above.items()}
    number = {name: position for position, name in enumerate(tree.links)}
    for loop in list(tree.loops()):
        del by[min((tie.child for tie in loop), key=number.__getitem__)]
    used = set(by.values())
    left_out = tuple(tie for tie in tree.ties if tie not in used)
    return Hanging(tuple(_parents_first(tree.links, by)), by, left_out)


def _parents_first(links: Iterable[str], by: Mapping[str, Tie]) -> dict[str, None]:
    ordered: dict[str, None] = {}
    for name in links:
        path: list[str] = []
        at = name
        while at != WORLD and at not in ordered:
            path.append(at)
            at = by[at].parent if at in by else WORLD
        ordered.update(dict.fromkeys(reversed(path)))
    return ordered
