"""Tree of links, and the degrees of freedom of the joints between them."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Iterator, Mapping

from checker.base.record import Record
from checker.model.components import Joint
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie

# About and along what a joint lets its child move.


class Freedom(enum.StrEnum):
    """Kind of one degree of freedom."""

    TURN = "turn"
    SLIDE = "slide"
    BALL = "ball"


_FREEDOMS = {
    "revolute": (Freedom.TURN,),
    "continuous": (Freedom.TURN,),
    "hinge": (Freedom.TURN,),
    "prismatic": (Freedom.SLIDE,),
    "universal": (Freedom.TURN, Freedom.TURN),
    "revolute2": (Freedom.TURN, Freedom.TURN),
    "ball": (Freedom.BALL,),
}


AXES = {
    kind: sum(freedom is not Freedom.BALL for freedom in freedoms)
    for kind, freedoms in _FREEDOMS.items()
}
"""Number of axes that moving joints need, by their type."""


class Motion(Record):
    """One way in which a joint moves.

    Attributes:
        number: The number of the joint's axis, from 0.
        axis: Direction in the robot's frame, of length 1; of a ball, any.
    """

    freedom: Freedom
    number: int
    axis: Vector


def motions_of(robot: Robot, joint: Joint) -> tuple[Motion, ...]:
    """Return how a joint moves, from parent to child; nothing if it is held fixed.

    Types that are not known, axes without direction and limits that leave no range hold it.
    """
    freedoms = _FREEDOMS.get(joint.type.value, ())
    if freedoms == (Freedom.BALL,):
        return (Motion(Freedom.BALL, 0, (0.0, 0.0, 1.0)),)
    motions = []
    for number, (freedom, axis) in enumerate(zip(freedoms, joint.axes, strict=False)):
        direction = robot.axis_in_model(joint, axis)
        endless = joint.type.value == "continuous"
        movable = endless or axis.lower.value != axis.upper.value
        if movable and direction is not None and all(map(math.isfinite, direction)):
            motions.append(Motion(freedom, number, direction))
    return tuple(motions)


class SpanningTree(Record, eq=False):
    """The links of a robot, parents before children.

    Attributes:
        order: Scoped names, each behind the one it is connected to.
        by: The tie of a link to its parent, by the link; roots have none.
        left_out: Ties whose child is connected to another link already.
    """

    order: tuple[str, ...]
    by: dict[str, Tie]
    left_out: tuple[Tie, ...]

    @property
    def depth_first(self) -> Iterator[str]:
        """The links so that all that is connected to one follows it without a gap."""
        below: dict[str | None, list[str]] = {}
        for name in self.order:
            tie = self.by.get(name)
            below.setdefault(tie.parent if tie is not None else None, []).append(name)
        waiting = [*reversed(below.get(WORLD, [])), *reversed(below.get(None, []))]
        while waiting:
            name = waiting.pop()
            yield name
            waiting.extend(reversed(below.get(name, [])))


def spanning_tree_of(robot: Robot) -> SpanningTree:
    """Connect each link by its first tie; a circle opens above its link that stands first."""
    tree = robot.tree
    by = {name: ties[0] for name, ties in tree.ties_above.items()}
    number = {name: position for position, name in enumerate(tree.links)}
    for loop in list(tree.loops()):
        del by[min((tie.child for tie in loop), key=number.__getitem__)]
    used = set(by.values())
    left_out = tuple(tie for tie in tree.ties if tie not in used)
    return SpanningTree(tuple(_parents_first(tree.links, by)), by, left_out)


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
