"""Links that fixed joints make one rigid body."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from checker.model.tree import WORLD, LinkTree
from checker.record import record

if TYPE_CHECKING:
    from checker.model.robot import Robot


@record(eq=False)
class RigidBodies:
    """The rigid bodies of a robot, each named for its first link.

    Attributes:
        of_link: The body of each link, by scoped name.
    """

    tree: LinkTree
    of_link: Mapping[str, str]

    @cached_property
    def neighbours(self) -> dict[str, set[str]]:
        """The bodies that a joint ties directly to each body."""
        tied: dict[str, set[str]] = {body: set() for body in self.of_link.values()}
        for tie in self.tree.ties:
            if tie.parent != WORLD:
                one, other = self.of_link[tie.parent], self.of_link[tie.child]
                tied[one].add(other)
                tied[other].add(one)
        return tied

    @cached_property
    def links(self) -> dict[str, list[str]]:
        """Scoped names of the links of each body."""
        links: dict[str, list[str]] = {}
        for link, body in self.of_link.items():
            links.setdefault(body, []).append(link)
        return links


def rigid_bodies(robot: Robot) -> RigidBodies:
    """Join the links that fixed joints tie."""
    leader = {name: name for name in robot.tree.links}

    def lead(name: str) -> str:
        while leader[name] != name:
            leader[name] = name = leader[leader[name]]
        return name

    for tie in robot.tree.ties:
        if tie.joint.type.value == "fixed" and tie.parent != WORLD:
            leader[lead(tie.child)] = lead(tie.parent)
    first: dict[str, str] = {}
    for name in robot.tree.links:
        first.setdefault(lead(name), name)
    return RigidBodies(robot.tree, {name: first[lead(name)] for name in robot.tree.links})
