"""Mass, centre of mass and inertia of a robot, and the load of its joints under gravity."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import msgspec
from msgspec.structs import replace

from checker.base.cache import NO_CACHE, Cache, code_hash, key_of
from checker.base.record import Record
from checker.base.resources import version_of
from checker.model.components import Joint, Link
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.physics.mass.balance import (
    Point,
    Stand,
    stand_of,
    tip_angle,
)
from checker.physics.mass.inertia import (
    inertial_pose,
    placed_inertia,
    principal_moments,
    pseudo_eigenvalue,
    rows_of,
)
from checker.physics.mass.leaning import collision_points, leaning_polygon
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.physics.mass.mechanism import (
    Freedom,
    Motion,
    SpanningTree,
    motions_of,
    spanning_tree_of,
)

if TYPE_CHECKING:
    import pinocchio as pin


# What joints hold against gravity.


def gravity_torques(
    robot: Robot,
    spanning_tree: SpanningTree,
    links: Mapping[str, LinkInertia],
    standing: frozenset[str],
) -> dict[Joint, float]:
    """Return the N·m (of sliding joints N) that hold each joint's first axis.

    This is Pinocchio's `computeGeneralizedGravity` for one axis at a time: in time linear in the
    links, without the square matrices that its `Data` has for thousands of joints.

    Args:
        robot: The robot.
        spanning_tree: The tree of links.
        links: Their masses and centres.
        standing: Names of links on the ground: what is above them is carried from below.
    """
    loads = {name: _load(link) for name, link in links.items()}
    stands = set(standing)
    torques: dict[Joint, float] = {}
    for name in reversed(spanning_tree.order):
        tie = spanning_tree.by.get(name)
        if tie is None:
            continue
        if tie.parent != WORLD:
            loads[tie.parent] = _sum(loads[tie.parent], loads[name])
            if name in stands:
                stands.add(tie.parent)
        motions = motions_of(robot, tie.joint)
        if name in stands or not motions or motions[0].freedom is Freedom.BALL:
            continue
        torque = _holding_effort(robot, tie.joint, motions[0], loads[name])
        if torque is not None:
            torques[tie.joint] = torque
    return torques


_Load = tuple[float, Vector]
"""Mass in kg, and mass times centre in kg·m."""


def _load(link: LinkInertia) -> _Load:
    """Return what gravity pulls at."""
    if not link.link.gravity.value or link.centre is None:
        return (0.0, (0.0, 0.0, 0.0))
    x, y, z = link.centre
    return (link.mass, (link.mass * x, link.mass * y, link.mass * z))


def _sum(a: _Load, b: _Load) -> _Load:
    return (a[0] + b[0], (a[1][0] + b[1][0], a[1][1] + b[1][1], a[1][2] + b[1][2]))


def _holding_effort(robot: Robot, joint: Joint, motion: Motion, load: _Load) -> float | None:
    """Return what an axis holds; None if that is not a number."""
    mass, (x, y, _) = load
    a, b, c = motion.axis
    if motion.freedom is Freedom.SLIDE:
        torque = mass * robot.gravity * c
    else:
        pose = robot.pose_of_joint(joint)
        if pose is None:
            return None
        ox, oy, _ = pose.translation
        # axis · (arm × force) with the force straight up, against the weight
        torque = robot.gravity * (a * (y - mass * oy) - b * (x - mass * ox))
    return torque if math.isfinite(torque) else None


# What Pinocchio computes of masses and moments; known weights need no Pinocchio.
#
# Loading it takes longer than all else that a check of a known robot does.


Rows = tuple[Vector, Vector, Vector]
_KIND = "weights"
_LEANING_KIND = "leaning"
_LIBRARIES = ("numpy", "pin")


class Body(Record):
    """Body whose mass counts.

    Attributes:
        mass: Kilograms.
        moments: Rows of the inertia about the centre of mass, kg·m².
        pose: The centre of mass and its axes in the robot's frame; None if unknown.
        piece: Name of the rigid piece that it is part of.
    """

    mass: float
    moments: Rows
    pose: Transform | None
    piece: str

    def as_json(self) -> list[Any]:
        """Return all that counts."""
        pose = None if self.pose is None else [self.pose.rotation, self.pose.translation]
        return [self.mass, self.moments, pose, self.piece]


class Weight(Record):
    """Mass properties of one body; see `LinkInertia`."""

    principal: Vector
    pseudo_eigenvalue: float
    piece_eigenvalue: float


class Weights(Record):
    """Mass properties of some bodies.

    Attributes:
        of_bodies: The masses in the order of the bodies.
        centre: The centre of mass of all bodies with a mass and a known place, in the robot's
            frame, metres; None if it is not known.
        inertia: Rows of the 3×3 inertia about this centre, robot's axes, kg·m²; likewise.
    """

    of_bodies: tuple[Weight, ...]
    centre: Vector | None
    inertia: Rows | None


def weights_of(bodies: Sequence[Body], cache: Cache) -> Weights:
    """Weigh bodies, each for itself and all as one rigid body."""
    request = json.dumps([body.as_json() for body in bodies])
    key = key_of(request, code_hash("physics/mass"), *map(version_of, _LIBRARIES))
    known = _from_json(cache.get(_KIND, key), len(bodies))
    if known is not None:
        return known
    weights = _weighed(bodies)
    cache.put(_KIND, key, msgspec.to_builtins(weights))
    return weights


def _from_json(members: Any, number: int) -> Weights | None:
    try:
        known = msgspec.convert(members, Weights)
    except msgspec.ValidationError:
        return None
    return known if len(known.of_bodies) == number else None


def _three(numbers: Sequence[float]) -> Vector:
    x, y, z = map(float, numbers)
    return (x, y, z)


def _weighed(bodies: Sequence[Body]) -> Weights:
    import numpy as np
    import pinocchio as pin

    own = []
    pieces = {body.piece: pin.Inertia.Zero() for body in bodies}
    doubtful = False
    for body in bodies:
        moments = np.array(body.moments)
        own.append((principal_moments(moments), pseudo_eigenvalue(body.mass, moments)))
        if body.pose is not None and 0.0 < body.mass < math.inf:
            pieces[body.piece] += placed_inertia(body.mass, moments, body.pose)
            doubtful |= math.isnan(own[-1][0][0])
    together = {name: pseudo_eigenvalue(it.mass, it.inertia) for name, it in pieces.items()}
    total = sum(pieces.values(), start=pin.Inertia.Zero())
    weights = tuple(
        Weight(principal, eigenvalue, together[body.piece])
        for body, (principal, eigenvalue) in zip(bodies, own, strict=True)
    )
    return Weights(weights, _centre(total), None if doubtful else _rows(total))


def _centre(total: pin.Inertia) -> Vector | None:
    centre = _three(total.lever)
    known = total.mass > 0.0 and all(map(math.isfinite, centre))
    return centre if known else None


def _rows(total: pin.Inertia) -> Rows | None:
    first, second, third = map(_three, total.inertia)
    known = total.mass > 0.0 and all(map(math.isfinite, (*first, *second, *third)))
    return (first, second, third) if known else None


def weigh(robot: Robot, cache: Cache = NO_CACHE) -> MassProperties:
    """Return mass, inertia and balance of a robot in the pose that it starts in.

    Time and memory are linear in the links.

    Args:
        robot: What is weighed.
        cache: The cache of weights.
    """
    pieces = robot.tree.rigid_bodies.of_link
    bodies = [
        Body(link.mass, rows_of(link), inertial_pose(robot, link), pieces[name])
        for name, link in robot.tree.links.items()
    ]
    weights = weights_of(bodies, cache)
    links = {
        name: _link_inertia(link, body, weight)
        for (name, link), body, weight in zip(
            robot.tree.links.items(), bodies, weights.of_bodies, strict=True
        )
    }
    stand = stand_of(robot)
    torques = {}
    if not stand.unknown:
        torques = gravity_torques(robot, spanning_tree_of(robot), links, stand.links)
    return MassProperties(
        robot=robot,
        mass=robot.mass,
        centre=weights.centre,
        inertia=weights.inertia,
        links=links,
        support=stand.polygon,
        support_height=stand.height,
        standing=stand.links,
        tip_angle=_tip_angle(robot, stand, weights.centre, cache),
        gravity_torques=torques,
        support_unknown=stand.unknown,
    )


_STABLE = math.radians(30.0)
"""A tip angle at which the search for a better stance ends."""


def _tip_angle(robot: Robot, stand: Stand, centre: Vector | None, cache: Cache) -> float | None:
    """Return how far the ground can tilt; a robot may first lean until more of it stands."""
    level = tip_angle(stand, centre)
    if level is None or centre is None or level > _STABLE:
        return level
    polygon = _leaning_polygon(collision_points(robot), centre, cache)
    leaning = tip_angle(replace(stand, polygon=polygon), centre)
    return level if leaning is None else max(level, leaning)


def _leaning_polygon(points: Sequence[Vector], centre: Vector, cache: Cache) -> tuple[Point, ...]:
    """Return what `leaning_polygon` does; to load the library behind it takes long."""
    request = json.dumps([points, centre])
    key = key_of(request, code_hash("physics/mass"), version_of("scipy"))
    try:
        return msgspec.convert(cache.get(_LEANING_KIND, key), tuple[Point, ...])
    except msgspec.ValidationError:
        polygon = leaning_polygon(points, centre)
        cache.put(_LEANING_KIND, key, msgspec.to_builtins(polygon))
        return polygon


def _link_inertia(link: Link, body: Body, weight: Weight) -> LinkInertia:
    """Return the inertia of a link; figures out of numbers that are not finite are NaN."""
    largest = weight.principal[2]
    sound = body.mass > 0.0 and largest >= 0.0 and math.isfinite(body.mass)
    return LinkInertia(
        link,
        body.mass,
        None if body.pose is None else body.pose.translation,
        weight.principal,
        weight.pseudo_eigenvalue,
        weight.piece_eigenvalue,
        math.sqrt(largest / body.mass) if sound else 0.0,
    )
