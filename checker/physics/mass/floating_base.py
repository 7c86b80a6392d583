"""Joints that stand for the free motion of a base: no motor moves them."""

from __future__ import annotations

from collections import Counter, defaultdict

from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.physics.mass.mechanism import Freedom, motions_of, spanning_tree_of

_MASSLESS = 1e-3
"""Share of the robot's mass that the links between these joints have at most."""


def floating_base(robot: Robot) -> frozenset[str]:
    """Return the scoped names of the six joints by which a base slides and turns freely.

    They are the first of the robot, one behind the other: three slide, three turn, and nothing but
    links without mass and collision is between them.
    """
    tree, below = spanning_tree_of(robot), defaultdict[str, list[str]](list)
    for name, tie in tree.by.items():
        below[tie.parent].append(name)
    at = WORLD if below[WORLD] else next(iter(tree.order), "")
    free: dict[str, Freedom] = {}
    while len(below[at]) == 1 and len(free) < 6 and _is_massless(robot, at):
        at = below[at][0]
        joint = tree.by[at].joint
        for motion in motions_of(robot, joint):
            free[joint.scoped_name] = motion.freedom
    counts = Counter(free.values())
    return frozenset(free if counts == {Freedom.SLIDE: 3, Freedom.TURN: 3} else ())


def _is_massless(robot: Robot, name: str) -> bool:
    link = robot.tree.links.get(name)
    return link is None or (not link.collisions and link.mass <= _MASSLESS * robot.mass)
