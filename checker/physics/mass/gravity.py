"""What joints hold against gravity."""

from __future__ import annotations

import math
from collections.abc import Mapping

from checker.model.components import Joint
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.physics.mass.hanging import Hanging
from checker.physics.mass.joint_motion import Freedom, Motion, motions_of
from checker.physics.mass.mass_properties import LinkInertia

GRAVITY = 9.81
"""m/s², as Pinocchio and MuJoCo have it; Gazebo's default is 9.8."""


def gravity_torques(
    robot: Robot,
    hanging: Hanging,
    links: Mapping[str, LinkInertia],
    standing: frozenset[str],
) -> dict[Joint, float]:
    """Return the N·m (of sliding joints N) that hold each joint's first axis.

    This is Pinocchio's `computeGeneralizedGravity` for one axis at a time: in time linear in the
    links, without the square matrices that its `Data` has for thousands of joints.

    Args:
        robot: Who holds.
        hanging: Which link hangs on which.
        links: Their masses and centres.
        standing: Names of links on the ground: what hangs above them is carried from below.
    """
    loads = {name: _load(link) for name, link in links.items()}
    stands = set(standing)
    torques: dict[Joint, float] = {}
    for name in reversed(hanging.order):
        tie = hanging.by.get(name)
        if tie is None:
            continue
        if tie.parent != WORLD:
            loads[tie.parent] = _sum(loads[tie.parent], loads[name])
            if name in stands:
                stands.add(tie.parent)
        motions = motions_of(robot, tie.joint)
        if name in stands or not motions or motions[0].freedom is Freedom.BALL:
            continue
        torque = _held(robot, tie.joint, motions[0], loads[name])
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


def _held(robot: Robot, joint: Joint, motion: Motion, load: _Load) -> float | None:
    """Return what an axis holds; None where that is no number."""
    mass, (x, y, _) = load
    a, b, c = motion.axis
    if motion.freedom is Freedom.SLIDE:
        torque = mass * GRAVITY * c
    else:
        pose = robot.pose_of_joint(joint)
        if pose is None:
            return None
        ox, oy, _ = pose.translation
        # axis · (arm × force) with the force straight up, against the weight
        torque = GRAVITY * (a * (y - mass * oy) - b * (x - mass * ox))
    return torque if math.isfinite(torque) else None
