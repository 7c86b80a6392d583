"""Largest loads of joints under gravity in the poses that their limits allow."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from functools import cached_property

from checker.base.record import Record
from checker.model.components import Joint
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.mechanism import SpanningTree, spanning_tree_of
from checker.physics.mass.pose_search import JointLoad, PoseSearch

MOST_JOINTS = 60
"""Moving joints of a robot whose poses are searched; one with two hands has about 50."""
_LONGEST = 1e3
"""Metres that a sliding joint moves at most."""


class ArmLoads(Record, eq=False, dict=True):
    """The joints of a robot that carry no part that stands on the ground.

    Attributes:
        masses: The robot.
        unknown: The reason why loads are not known, as the end of a sentence; empty if they are.
    """

    masses: MassProperties
    unknown: str = ""

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self.masses.robot

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints with an effort limit."""
        return tuple(
            joint
            for joint in self.masses.gravity_torques
            if len(joint.axes) == 1 and 0.0 < joint.axes[0].effort.value < math.inf
        )

    @cached_property
    def tool(self) -> str:
        """Scoped name of the link behind the most of them, of several the last, no finger."""
        return _tool(self.masses.robot, {joint.scoped_name for joint in self.joints})

    def loads(self, payload: float = 0.0) -> Iterator[JointLoad]:
        """Yield the largest load of each joint that may exceed its effort limit.

        Args:
            payload: Mass in the origin of the tool, kg.
        """
        tool = self.tool if payload else ""
        bounds = load_bounds(self.masses, tool, payload)
        heavy = [joint for joint in self.joints if bounds[joint] > joint.axes[0].effort.value]
        if heavy:
            # Only here is Pinocchio loaded, which takes longer than the rest.
            search = PoseSearch(self.masses.robot, tool, payload)
            yield from (search.worst(it) for it in heavy if it.scoped_name in search.coordinates)


def arm_loads(masses: MassProperties) -> ArmLoads:
    """Return the joints of a robot whose loads matter, or why these are not known."""
    robot = masses.robot
    moving = sum(joint.type.value != "fixed" for joint in robot.joints)
    unknown = masses.unbalanced or robot.unread_plugins
    if not unknown and moving > MOST_JOINTS:
        unknown = f"it has {moving} moving joints; poses of at most {MOST_JOINTS} are searched"
    return ArmLoads(masses, unknown)


_ARM = 3
"""Joints in front of a hand, at least: what branches or slides behind them are fingers."""


def _tool(robot: Robot, joints: set[str]) -> str:
    """Return the link behind the most of some joints, of several the last; fingers are left out."""
    tree = spanning_tree_of(robot)
    moving = Counter(
        tie.parent for tie in tree.by.values() if tie.joint.type.value in ("revolute", "continuous")
    )
    behind: dict[str, int] = {}
    for name in tree.order:
        tie = tree.by.get(name)
        if tie is None or tie.parent == WORLD:
            behind[name] = 0
        elif (above := behind.get(tie.parent)) is not None:
            is_finger = tie.joint.type.value == "prismatic" or moving[tie.parent] > 1
            if tie.joint.type.value == "fixed" or above < _ARM or not is_finger:
                behind[name] = above + (tie.joint.scoped_name in joints)
    return max(reversed(behind), key=behind.__getitem__, default="")


def load_bounds(masses: MassProperties, tool: str, payload: float) -> dict[Joint, float]:
    """Return what the loads of joints cannot exceed: all masses behind them at full reach.

    Args:
        masses: The robot.
        tool: Scoped name of the link that carries a payload.
        payload: Its mass, kg.

    Returns:
        N·m, of sliding joints N.
    """
    robot, tree = masses.robot, spanning_tree_of(masses.robot)
    ways = _ways(robot, tree)
    weights, moments = dict.fromkeys(tree.order, 0.0), dict.fromkeys(tree.order, 0.0)
    bounds: dict[Joint, float] = {}
    for name in reversed(tree.order):
        origin, way = ways[name]
        for mass, centre in _masses_of(masses, name, payload if name == tool else 0.0):
            weights[name] += mass
            moments[name] += mass * (way + math.dist(origin, centre))
        tie = tree.by.get(name)
        if tie is None:
            continue
        slides = tie.joint.type.value == "prismatic"
        held = weights[name] if slides else moments[name] - weights[name] * way
        bounds[tie.joint] = robot.gravity * held
        if tie.parent != WORLD:
            weights[tie.parent] += weights[name]
            moments[tie.parent] += moments[name]
    return bounds


def _masses_of(masses: MassProperties, name: str, payload: float) -> Iterator[tuple[float, Vector]]:
    """Yield what gravity pulls at in a link, kg, and where, metres in the robot's frame."""
    link, pose = masses.links[name], masses.robot.pose_of(name)
    if link.link.gravity.value and link.centre is not None:
        yield link.mass, link.centre
    if payload and pose is not None:
        yield payload, pose.translation


def _ways(robot: Robot, tree: SpanningTree) -> dict[str, tuple[Vector, float]]:
    """Return the origin of each link's joint, and the longest way to it by all joints, metres."""
    ways: dict[str, tuple[Vector, float]] = {WORLD: ((0.0, 0.0, 0.0), 0.0)}
    for name in tree.order:
        tie = tree.by.get(name)
        before, way = ways[tie.parent if tie is not None else WORLD]
        pose = robot.pose_of_joint(tie.joint) if tie is not None else robot.pose_of(name)
        origin = before if pose is None else pose.translation
        if tie is not None and tie.joint.type.value == "prismatic":
            limits = [abs(end.value) for it in tie.joint.axes for end in (it.lower, it.upper)]
            way += min(max(limits, default=0.0), _LONGEST)
        ways[name] = origin, way + math.dist(before, origin)
    return ways
