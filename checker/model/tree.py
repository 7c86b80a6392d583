"""Tree of links: the joints of a robot as a graph of its links."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Joint, Link
from checker.model.frames import MODEL_FRAME
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot


WORLD = "world"


class Tie(Record, eq=False):
    """A joint both ends of which are known.

    Attributes:
        parent: Scoped name of a link, or `world`.
        child: Scoped name of a link.
    """

    joint: Joint
    parent: str
    child: str


class BrokenTie(Record, eq=False):
    """A joint one end of which, or both, is no link.

    Attributes:
        missing: The end that is unknown; the child if both are.
        known: Scoped name of the link at the other end, or `world`; None if it is unknown too.
    """

    joint: Joint
    missing: Located[str]
    known: str | None


class LinkTree(Record, eq=False, dict=True):
    """The links of a robot and what ties them; in a sound robot, one tree.

    Nothing here recurses, and all of it takes time linear in links and joints.

    Attributes:
        links: The links by scoped name, in the order of the file.
        ties: The ties in the order of the joints.
        broken: Joints with an unknown end.
    """

    links: dict[str, Link]
    ties: tuple[Tie, ...]
    broken: tuple[BrokenTie, ...]

    @cached_property
    def ties_above(self) -> dict[str, list[Tie]]:
        """Ties that connect each link to its parents, by the link; in a tree, one at most."""
        above: dict[str, list[Tie]] = {}
        for tie in self.ties:
            if tie.parent != tie.child:
                above.setdefault(tie.child, []).append(tie)
        return above

    @cached_property
    def groups(self) -> list[list[str]]:
        """Links that are tied together, directly or over others, in the order of the file.

        What is tied to the world is tied together.
        """
        leader = {name: name for name in (*self.links, WORLD)}

        def lead(name: str) -> str:
            while leader[name] != name:
                leader[name] = name = leader[leader[name]]
            return name

        for tie in self.ties:
            leader[lead(tie.child)] = lead(tie.parent)
        groups: dict[str, list[str]] = {}
        for name in self.links:
            groups.setdefault(lead(name), []).append(name)
        return list(groups.values())

    @cached_property
    def rigid_bodies(self) -> RigidBodies:
        """The links, joined where fixed joints tie them."""
        leader = {name: name for name in self.links}

        def lead(name: str) -> str:
            while leader[name] != name:
                leader[name] = name = leader[leader[name]]
            return name

        for tie in self.ties:
            if _is_fixed(tie) and tie.parent != WORLD:
                leader[lead(tie.child)] = lead(tie.parent)
        first: dict[str, str] = {}
        for name in self.links:
            first.setdefault(lead(name), name)
        return RigidBodies(self, {name: first[lead(name)] for name in self.links})

    @cached_property
    def links_fixed_to_world(self) -> frozenset[str]:
        """Links that fixed joints connect to the world, directly or through others."""
        fixed = (tie.child for tie in self.ties if tie.parent == WORLD and _is_fixed(tie))
        return self._with_their_bodies(fixed)

    @cached_property
    def base(self) -> frozenset[str]:
        """Links that have no parent, and those that are fixed to them."""
        return self._with_their_bodies(name for name in self.links if name not in self.ties_above)

    def _with_their_bodies(self, names: Iterable[str]) -> frozenset[str]:
        bodies = self.rigid_bodies
        wanted = {bodies.of_link[name] for name in names}
        return frozenset(name for body in wanted for name in bodies.links[body])

    def loops(self) -> Iterator[list[Tie]]:
        """Yield the loops of links, each by its first tie above."""
        done: set[str] = set()
        for start in self.links:
            path: dict[str, Tie] = {}
            at = start
            while at not in done and at not in path and at in self.ties_above:
                path[at] = self.ties_above[at][0]
                at = path[at].parent
            if at in path:
                names = list(path)
                yield [path[name] for name in names[names.index(at) :]]
            done.update(path)


def _is_fixed(tie: Tie) -> bool:
    return tie.joint.type.value == "fixed"


def link_tree(robot: Robot) -> LinkTree:
    """Tie the links of a robot by its joints."""
    carriers = _Carriers(robot)
    ties: list[Tie] = []
    broken: list[BrokenTie] = []
    for joint in robot.joints:
        parent = WORLD if joint.parent.value == WORLD else carriers.link_of(joint, joint.parent)
        child = carriers.link_of(joint, joint.child)
        if parent is not None and child is not None:
            ties.append(Tie(joint, parent, child))
        elif child is None:
            broken.append(BrokenTie(joint, joint.child, parent))
        else:
            broken.append(BrokenTie(joint, joint.parent, child))
    links = {link.scoped_name: robot.links_by_name[link.scoped_name] for link in robot.links}
    return LinkTree(links, tuple(ties), tuple(broken))


class _Carriers:
    """Finds the link that carries a frame: links, frames, joints and models all are frames."""

    def __init__(self, robot: Robot) -> None:
        self.known = robot.attachable_names
        self.links = robot.links_by_name
        self.attached: dict[str, str] = {MODEL_FRAME: canonical_link(robot) or ""}
        for frame in robot.frames:
            scope = frame.scoped_name.removesuffix(frame.name.value)
            to = frame.attached_to
            inside = scope + to if to not in ("", MODEL_FRAME) else ""
            self.attached[frame.scoped_name] = inside or scope.removesuffix("::") or MODEL_FRAME
        for joint in robot.joints:
            self.attached.setdefault(joint.scoped_name, joint.scope + joint.child.value)
        first = _first_links(robot)
        for model in robot.models:
            inside = f"{model.scoped_name}::"
            stated = (model.element.get("canonical_link") or "").strip()
            carrier = inside + stated if stated else first.get(inside, "")
            self.attached.setdefault(model.scoped_name, carrier)
            self.attached[f"{model.scoped_name}::{MODEL_FRAME}"] = carrier
        self.found: dict[str, str | None] = {}

    def link_of(self, joint: Joint, end: Located[str]) -> str | None:
        """Return the scoped name of the link that carries an end of a joint; None without."""
        name = joint.scope + end.value
        if name not in self.known:
            return None
        path: dict[str, None] = {}
        at = name
        while at not in self.links and at not in self.found and at not in path:
            path[at] = None
            at = self.attached.get(at, "")
        carrier = at if at in self.links else self.found.get(at)
        self.found.update(dict.fromkeys(path, carrier))
        return carrier


def canonical_link(robot: Robot) -> str | None:
    """Return the link that represents the model: the one it names, else its first."""
    stated = (robot.element.get("canonical_link") or "").strip()
    return stated or _first_links(robot).get("")


def _first_links(robot: Robot) -> dict[str, str]:
    """Return the first link of each model by its prefix; those of models inside come later."""
    first: dict[str, str] = {}
    for link in sorted(robot.links, key=lambda link: link.scoped_name.count("::")):
        prefix = link.scoped_name.removesuffix(link.name.value)
        while prefix not in first:
            first[prefix] = link.scoped_name
            if not prefix:
                break
            prefix = "".join(prefix.removesuffix("::").rpartition("::")[:2])
    return first


# Links that fixed joints make one rigid body.


class RigidBodies(Record, eq=False, dict=True):
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
