"""Legs: joints in series below a body, whose last link stands on the ground."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from checker.model.components import Joint, Link
from checker.model.locomotion.drive import DRIVE_CLASSES

if TYPE_CHECKING:
    from checker.model.robot import Robot

_WALKS = "AnymalControlPlugin"
_JOINT_CONTROLLERS = (
    "ApplyJointForce",
    "ConfigurableJointPositionController",
    "JointPositionController",
)
_FEWEST_JOINTS = 6
"""Controlled joints of a robot that walks: two legs of three joints."""
_FEWEST_IN_SERIES = 2
"""Joints of a leg; flaps and rudders have one."""
_LEVEL = 0.01
"""Metres by which a foot may be above the lowest point of the body."""


def is_legged(robot: Robot) -> bool:
    """Return whether a robot walks: by a plugin for legs, or by joint controllers alone."""
    classes = [plugin.class_name for plugin in robot.plugins]
    if any(name in DRIVE_CLASSES for name in classes):
        return _WALKS in classes
    controlled = sum(name in _JOINT_CONTROLLERS for name in classes)
    return controlled >= _FEWEST_JOINTS and _stands_on_legs(robot, robot.driven_joints)


def looks_legged(robot: Robot) -> bool:
    """Return whether a robot stands on its joints, whatever moves them."""
    moving = {joint.scoped_name for joint in robot.joints if joint.axes and not joint.immovable}
    return len(moving) >= _FEWEST_JOINTS and _stands_on_legs(robot, moving)


def _stands_on_legs(robot: Robot, driven: Collection[str]) -> bool:
    """Return whether two legs or more reach as far down as the body between them.

    Arms on a column, gimbals below a copter, and flaps do not.

    Args:
        robot: The robot.
        driven: Scoped names of the joints that a leg consists of.
    """
    legs: dict[Joint, float] = {}
    body: list[float] = []
    for link in robot.links:
        height = _height(robot, link)
        above = list(_driven_above(robot, link, driven))
        if height is None:
            continue
        if len(above) >= _FEWEST_IN_SERIES:
            legs[above[-1]] = min(height, legs.get(above[-1], height))
        else:
            body.append(height)
    ground = min(body, default=0.0) + _LEVEL
    return sum(foot <= ground for foot in legs.values()) > 1


def _height(robot: Robot, link: Link) -> float | None:
    """Return the lowest point of a link, its origin where its shapes are not known; metres."""
    box = robot.box_of(link)
    if box is not None:
        return box.low[2]
    pose = robot.pose_of(link.scoped_name)
    return None if pose is None else pose.translation[2]


def _driven_above(robot: Robot, link: Link, driven: Collection[str]) -> Iterator[Joint]:
    """Yield the driven joints between a link and the base, from the link upwards."""
    name, seen = link.scoped_name, set[str]()
    while name not in seen and (ties := robot.tree.ties_above.get(name)):
        seen.add(name)
        if ties[0].joint.scoped_name in driven:
            yield ties[0].joint
        name = ties[0].parent
