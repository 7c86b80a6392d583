"""The links of a robot as nested bodies of MuJoCo, with their inertias and contact shapes."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from checker.base.record import Record
from checker.formats.friction import FrictionReader
from checker.model.components import Link
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.physics.mass.mechanism import SpanningTree, spanning_tree_of
from checker.physics.trial.mjcf.geoms import Geom, GeomReader, is_solid, sliding_friction
from checker.physics.trial.mjcf.inertials import BodyInertia, inertia_of, thickened
from checker.physics.trial.mjcf.joints import degrees_of
from checker.physics.trial.mjcf.names import Names, is_finite_pose, numbers, pose_attributes
from checker.physics.trial.mjcf.repairs import Ledger

# The links of a robot as trees that MuJoCo can nest: each link hangs on one other at most.


class Forest(Record, eq=False, dict=True):
    """The links of a robot, from those that have no parent downwards."""

    spanning_tree: SpanningTree

    @property
    def order(self) -> tuple[str, ...]:
        """Scoped names of the links, each behind the one that it is connected to."""
        return self.spanning_tree.order

    @cached_property
    def children(self) -> dict[str, list[str]]:
        """Links that are connected to each link, and to the world, by a joint."""
        below: dict[str, list[str]] = {}
        for name in self.order:
            tie = self.tie(name)
            if tie is not None:
                below.setdefault(tie.parent, []).append(name)
        return below

    @cached_property
    def tops(self) -> list[str]:
        """Links without a parent, or with the world as parent."""
        return [name for name in self.order if self.base(name) is None]

    def tie(self, name: str) -> Tie | None:
        """Return the tie of a link to its parent; None for one that is free."""
        return self.spanning_tree.by.get(name)

    def base(self, name: str) -> str | None:
        """Return the link that a link is connected to; None if that is the world or nothing."""
        tie = self.tie(name)
        return tie.parent if tie is not None and tie.parent != WORLD else None

    def under(self, start: str) -> Iterator[str]:
        """Yield a link and all that is connected to it, over others too."""
        waiting = [start]
        while waiting:
            name = waiting.pop()
            yield name
            waiting.extend(self.children.get(name, []))


class Layout:
    """The parts of a robot as a scene takes them; all by the scoped name of the link.

    Attributes:
        ledger: What had to be changed or left out.
        forest: The trees of links.
        poses: The poses in the robot's frame.
        degrees: The motion of each link relative to its parent.
        held: The link that the trial holds in place, since nothing shows that the robot stands on
            the ground by itself; empty without.
        welded: The link that each link moves with; `world` for what does not move.
        hulls: The corners of meshes and cones by the name of their asset, metres.
        geoms: Shapes that touch, each with its friction.
        inertias: Masses and moments, as far as needed repaired.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.ledger = Ledger()
        self.forest = Forest(spanning_tree_of(robot))
        self._say_what_is_cut()
        self.poses = self._poses()
        self.degrees = {
            child: degrees_of(robot, tie.joint, self.ledger)
            for child, tie in self.forest.spanning_tree.by.items()
        }
        self.held = self._held_link()
        self.welded = self._welded()
        reader, friction = GeomReader(robot, self.poses, self.ledger), FrictionReader(robot)
        self.geoms = {
            link.scoped_name: list(self._geoms_of(link, reader, friction)) for link in self._links()
        }
        self.hulls = {name: points for points, name in reader.assets.items()}
        self.inertias = self._inertias()

    @property
    def lowest(self) -> float:
        """Z of the lowest collision point in the robot's frame, metres; 0 without any."""
        heights = [geom.lowest for geoms in self.geoms.values() for geom, _ in geoms]
        return min(heights, default=0.0)

    @property
    def stands(self) -> bool:
        """Whether a part of the robot is not fixed to the world."""
        return any(self.forest.tie(name) is None for name in self.forest.tops)

    @property
    def jointed_pairs(self) -> tuple[tuple[str, str], ...]:
        """Pairs of links that others move with and that a joint lets move against each other."""
        pairs: dict[tuple[str, str], None] = {}
        for tie in self.robot.tree.ties:
            first = WORLD if tie.parent == WORLD else self.welded[tie.parent]
            second = self.welded[tie.child]
            if first != second:
                pairs[first, second] = None
        return tuple(pairs)

    def _links(self) -> Iterator[Link]:
        """Yield the links, parents before children."""
        for name in self.forest.order:
            yield self.robot.tree.links[name]

    def _geoms_of(
        self, link: Link, reader: GeomReader, friction: FrictionReader
    ) -> Iterator[tuple[Geom, float]]:
        for collision in link.collisions:
            if not is_solid(collision):
                self.ledger.note("A collision is set to touch nothing", link.scoped_name)
            elif (geom := reader.geom_of(link, collision)) is not None:
                yield geom, sliding_friction(friction, link, collision, self.ledger)

    def _inertias(self) -> dict[str, BodyInertia]:
        """Weigh each link; of what moves together, one at least must have mass and moments."""
        inertias = {
            link.scoped_name: inertia_of(self.robot, link, self.ledger) for link in self._links()
        }
        sound = {self.welded[name] for name, inertia in inertias.items() if inertia.sound}
        for name in self.forest.order:
            if self.welded[name] == name and name not in sound:
                inertias[name] = thickened(inertias[name], name, self.ledger)
        return inertias

    def _poses(self) -> dict[str, Transform]:
        poses: dict[str, Transform] = {}
        for name in self.forest.order:
            pose = self.robot.pose_of(name)
            if pose is None or not is_finite_pose(pose):
                base = self.forest.base(name)
                pose = poses[base] if base is not None else Transform()
                where = "the pose of its parent link" if base is not None else "the origin"
                self.ledger.repair(name, f"has an unknown pose; {where} is used")
            poses[name] = pose
        return poses

    def _held_link(self) -> str:
        free = [name for name in self.forest.order if self.forest.tie(name) is None]
        if self.robot.stands_alone or len(free) != 1:
            return ""
        self.ledger.note(HELD, free[0])
        return free[0]

    def _welded(self) -> dict[str, str]:
        welded: dict[str, str] = {WORLD: WORLD}
        for name in self.forest.order:
            tie = self.forest.tie(name)
            if tie is None:
                welded[name] = WORLD if name == self.held else name
            else:
                welded[name] = name if self.degrees[name] else welded[tie.parent]
        return welded

    def _say_what_is_cut(self) -> None:
        for tie in self.forest.spanning_tree.left_out:
            what = f"connects {tie.parent} with {tie.child}, which already has a parent"
            self.ledger.repair(tie.joint.scoped_name, f"{what}, and is left out")
        for broken in self.robot.tree.broken:
            what = f"connects {broken.missing.value!r}, which is not a link, and is left out"
            self.ledger.repair(broken.joint.scoped_name, what)
        for link in self._links():
            if link.kinematic.value:
                sentence = "Links are kinematic; the trial lets forces move them"
                self.ledger.note(sentence, link.scoped_name)


HELD = "The URDF has neither wheels nor a drive: the trial holds its base in place"
"""Start of the note about such a robot."""


# The links of a robot as nested bodies of MuJoCo.


_BELT = 'surfacevel="1e-9 0 0 0 0 0"'
"""MuJoCo has room for a surface velocity only where the text states one that is not zero."""
_TOUCHES_GROUND_ALONE = 'contype="0" conaffinity="1" condim="3" priority="1"'


class BodyWriter:
    """Writes bodies with the joints, inertias and geoms in them, and names them.

    Attributes:
        names: Complete once the text is written.
    """

    def __init__(self, layout: Layout, belts: frozenset[str]) -> None:
        self.layout = layout
        self.belts = belts
        self.names = Names()

    def text(self, height: float) -> str:
        """Return all bodies, without recursion: robots may be thousands of links deep.

        Args:
            height: z of the robot's frame, metres.
        """
        forest, poses = self.layout.forest, self.layout.poses
        lift = Transform(translation=(0.0, 0.0, height))
        lines: list[str] = []
        waiting: list[str | None] = list(reversed(forest.tops))
        while waiting:
            name = waiting.pop()
            if name is None:
                lines.append("</body>")
                continue
            base = forest.base(name)
            start = lift if base is None else poses[base].inverse
            lines.extend(self._opened(name, start @ poses[name]))
            waiting.append(None)
            waiting.extend(reversed(forest.children.get(name, [])))
        return "\n".join(lines)

    def _opened(self, name: str, pose: Transform) -> Iterator[str]:
        """Yield a body and what is in it, all but the bodies below and the end."""
        link = self.layout.robot.tree.links[name]
        weightless = "" if link.gravity.value else ' gravcomp="1"'
        yield f'<body name="{self.names.body(name)}" {pose_attributes(pose)}{weightless}>'
        yield from self._joints(name)
        yield self.layout.inertias[name].mjcf
        yield from self._geoms(name)

    def _joints(self, name: str) -> Iterator[str]:
        tie = self.layout.forest.tie(name)
        if name == self.layout.held:
            return
        if tie is None:
            yield f'<freejoint name="{self.names.free_joint(name)}"/>'
            return
        degrees = self.layout.degrees[name]
        if not degrees:
            return
        joint = tie.joint.scoped_name
        own = self.names.joint(joint, ball=degrees[0].kind == "ball")
        inverse = self.layout.poses[name].inverse
        at = self.layout.robot.pose_of_joint(tie.joint)
        known = at is not None and is_finite_pose(at)
        anchor = inverse.apply(at.translation) if at is not None and known else (0.0, 0.0, 0.0)
        for degree, mj in zip(degrees, (own, f"{own}_2"), strict=False):
            axis = Transform(inverse.rotation).rotate(degree.axis)
            yield f'<joint name="{mj}" pos="{numbers(anchor)}" {degree.mjcf(axis)}/>'

    def _geoms(self, name: str) -> Iterator[str]:
        belt = name in self.belts
        own = []
        for geom, friction in self.layout.geoms[name]:
            mj = self.names.geom(name)
            own.append(mj)
            slide = f'friction="{numbers([friction])} 0 0" {_BELT if belt else ""}'
            yield f'<geom name="{mj}" {geom.mjcf} {_TOUCHES_GROUND_ALONE} {slide}/>'
        if belt:
            self.names.belts[name] = tuple(own)
