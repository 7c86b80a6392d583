"""The links of a URDF as bodies: what fixed joints tie becomes one, as in Gazebo's parser."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import field

from checker.base.record import Record
from checker.convert.conversion import Notes
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.fixed_joints import Lumping
from checker.model.components import Link
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.physics.mass.mechanism import spanning_tree_of


class PartOfBody(Record, eq=False):
    """A link of the source within a body.

    Attributes:
        pose: The pose of the link's frame in the body's.
    """

    link: Link
    pose: Transform


class Body(Record, eq=False):
    """A link of the result.

    Attributes:
        parts: Links of the source that become this one; the first gives its name and frame.
        tie: The tie that connects it to another body; None without one.
    """

    parts: list[PartOfBody]
    tie: Tie | None

    @property
    def link(self) -> Link:
        """The link whose name and frame it has."""
        return self.parts[0].link

    @property
    def mass(self) -> float:
        """Kilograms of all its parts."""
        return sum(part.link.mass for part in self.parts)


class Bodies(Record, eq=False):
    """The bodies of a robot.

    Attributes:
        bodies: The bodies by the name of the link whose frame they have, parents before children.
        holders: The body that a link of the source is part of, by its name.
        poses: The pose of a link of the source in that body's frame.
        left_out: Ties that would let a body be connected to two others.
    """

    bodies: dict[str, Body] = field(default_factory=dict)
    holders: dict[str, Body] = field(default_factory=dict)
    poses: dict[str, Transform] = field(default_factory=dict)
    left_out: tuple[Tie, ...] = ()


def bodies_of(robot: Robot, description: UrdfDescription, notes: Notes) -> Bodies:
    """Lump a robot; links without mass that Gazebo's parser drops are dropped, with a note."""
    spanning_tree = spanning_tree_of(robot)
    kept = Lumping(description).kept_joints
    bodies = Bodies(left_out=spanning_tree.left_out)
    for name in spanning_tree.depth_first:
        link, tie = robot.tree.links[name], spanning_tree.by.get(name)
        if name == WORLD:
            continue
        holder = bodies.holders.get(tie.parent) if tie is not None else None
        pose = Transform()
        if tie is None or holder is None or not _lumped(tie, link, kept, notes):
            holder = bodies.bodies[name] = Body([], tie)
        else:
            pose = bodies.poses[tie.parent] @ tie.joint.pose.transform
        holder.parts.append(PartOfBody(link, pose))
        bodies.holders[name], bodies.poses[name] = holder, pose
    _drop_massless(bodies, notes)
    return bodies


def _lumped(tie: Tie, link: Link, kept: frozenset[str], notes: Notes) -> bool:
    """Return whether a link becomes part of the one that it is connected to."""
    if tie.joint.type.value != "fixed":
        return False
    if tie.joint.name.value not in kept:
        return True
    if link.mass == 0.0:
        reason = "has no mass: its fixed joint is lumped, although a <gazebo> tag asks to keep it"
        notes.say(link, f"link {link.name.value!r} {reason}")
        return True
    return False


def _drop_massless(bodies: Bodies, notes: Notes) -> None:
    """Drop bodies without mass without children, from the ends of the tree inwards."""
    carrying: set[str] = set()
    for name, body in reversed(list(bodies.bodies.items())):
        if body.mass == 0.0 and name not in carrying and len(bodies.bodies) > 1:
            notes.say(body.link, f"link {name!r} has no mass: left out, as in Gazebo")
            del bodies.bodies[name]
            for part in body.parts:
                del bodies.holders[part.link.scoped_name]
            continue
        if body.mass == 0.0:
            reason = "Gazebo drops it with all links below it, so it needs an <inertial>"
            notes.say(body.link, f"link {name!r} has no mass: {reason}")
        if body.tie is not None and body.tie.parent in bodies.holders:
            carrying.add(bodies.holders[body.tie.parent].link.scoped_name)


# The mass and inertia of several links as those of one.


_PLACES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


class JoinedInertial(Record):
    """Mass, centre of mass and inertia of a body.

    Attributes:
        mass: Kilograms.
        centre: Centre of mass in the body's frame, metres.
        moments: ixx, ixy, ixz, iyy, iyz, izz about it along the body's axes, kg·m².
    """

    mass: float
    centre: Vector
    moments: tuple[float, ...]


def joined_inertial(parts: Sequence[PartOfBody]) -> JoinedInertial:
    """Join the inertias of links about their common centre of mass.

    Each is turned into the body's axes and moved by the parallel axis theorem,
    I + m (|d|² E − d dᵀ) with d from the common centre of mass to its own.
    """
    import numpy as np

    stated = [
        (part.pose @ part.link.inertial.pose.transform, part.link.inertial)
        for part in parts
        if part.link.inertial is not None
    ]
    mass = sum(inertial.mass.value for _, inertial in stated)
    centre = np.zeros(3)
    for pose, inertial in stated:
        share = inertial.mass.value / mass if mass else 1.0 / len(stated)
        centre += share * np.array(pose.translation)
    moments = np.zeros((3, 3))
    for pose, inertial in stated:
        xx, xy, xz, yy, yz, zz = (moment.value for moment in inertial.moments)
        own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn, arm = np.array(pose.rotation), np.array(pose.translation) - centre
        moved = float(arm @ arm) * np.eye(3) - np.outer(arm, arm)
        moments += turn @ own @ turn.T + inertial.mass.value * moved
    x, y, z = centre.tolist()
    six = tuple(float(moments[row, column]) for row, column in _PLACES)
    return JoinedInertial(mass, (x, y, z), six)


def single_inertial_part(parts: Sequence[PartOfBody]) -> PartOfBody | None:
    """Return the one part that states an inertial; None if there are several or none."""
    stated = [part for part in parts if part.link.inertial is not None]
    return stated[0] if len(stated) == 1 else None


def frame_of(part: PartOfBody) -> Transform:
    """Return the centre of mass and axes of a part in its body's frame."""
    inertial = part.link.inertial
    return part.pose if inertial is None else part.pose @ inertial.pose.transform
