"""Joints that controllers or plugins put in place one by one: those of arms, hands and gimbals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Joint
from checker.model.controllers import Controller
from checker.model.locomotion.controlled import DRIVING_CONTROLLERS
from checker.model.values import parse_number

if TYPE_CHECKING:
    from checker.model.robot import Robot

_PUBLISHERS = ("Broadcaster", "JointStateController")
"""Ends of the classes of controllers that move nothing."""
_JOINTS = ("joints", "joint", "dof_names")
"""Parameters that name joints, of controllers that are no drive."""
_OF_GRIPPERS = ("joint",)
_GRIPPER = "GripperActionController"
"""Class of a controller that reads no list of joints."""
_TRAJECTORIES = "JointTrajectoryController"
"""Class of a plugin of Gazebo Sim that moves all joints if it names none."""
_PLUGINS = frozenset(
    {
        *("JointPositionController", _TRAJECTORIES, "JointController"),
        *("ConfigurableJointPositionController", "GimbalControlPlugin", "FlipperControlPlugin"),
    }
)
"""Classes of plugins that move joints and need no ground, water or air for it."""


class Mover(Record):
    """What commands a joint: the class of a controller or plugin, and the controller's name."""

    kind: str
    name: str = ""


class Follower(Record):
    """What a joint copies.

    Attributes:
        joint: Scoped name of the other joint.
        ratio: The motion of this joint / that of the other.
        offset: Its position where the other is at 0, rad or m.
    """

    joint: str
    ratio: float
    offset: float = 0.0


def moving_controllers(robot: Robot) -> list[Controller]:
    """Return the controllers that do not only publish."""
    return [each for each in robot.controllers if not each.class_name.endswith(_PUBLISHERS)]


def commanded_joints(robot: Robot) -> dict[str, Mover]:
    """Return the scoped names of the joints that are commanded, each with what commands it."""
    commanded: dict[str, Mover] = {}
    for controller in moving_controllers(robot):
        if controller.class_name not in DRIVING_CONTROLLERS:
            mover = Mover(controller.class_name, controller.name)
            parameters = _OF_GRIPPERS if controller.class_name == _GRIPPER else _JOINTS
            still = {joint.value for joint in controller.joints_without_gains}
            for named in controller.texts(*parameters):
                if named.value in robot.joints_by_name and named.value not in still:
                    commanded.setdefault(named.value, mover)
    for name, kind in _by_plugins(robot):
        commanded.setdefault(name, Mover(kind))
    return commanded


def has_own_joints(controller: Controller, robot: Robot) -> bool:
    """Return whether a controller names joints by parameters of its own, as `wheel_joints`."""
    own = (it for name, it in controller.parameters.items() if name not in _JOINTS)
    return any(text.value in robot.joints_by_name for it in own for text in it.texts)


def _by_plugins(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield the scoped names of joints, each with the class of the plugin that moves it."""
    for name, plugin in robot.driven_joints.items():
        if plugin.class_name in _PLUGINS:
            yield name, plugin.class_name
    for plugin in robot.plugins:
        if plugin.class_name == _TRAJECTORIES and not plugin.values("joint_name"):
            yield from ((joint.scoped_name, plugin.class_name) for joint in robot.joints)


def followers(robot: Robot) -> dict[str, Follower]:
    """Return the joints that copy another one, by their scoped names."""
    return {
        joint.scoped_name: _follower(joint)
        for joint in robot.joints
        if joint.mimics and joint.scope + joint.mimics[0].value in robot.joints_by_name
    }


def _follower(joint: Joint) -> Follower:
    """Return what a joint with a `<mimic>` copies: URDF states numbers as attributes, SDF below."""
    holders = (joint.element, *joint.element.all("axis"))
    (mimic, *_) = (mimic for holder in holders for mimic in holder.all("mimic"))

    def number(name: str, default: float) -> float:
        stated = mimic.child(name)
        text = stated.text.value if stated is not None else mimic.get(name)
        value = parse_number(text or "")
        return default if value is None else value

    ratio = number("multiplier", 1.0)
    offset = number("offset", 0.0) - ratio * number("reference", 0.0)
    return Follower(joint.scope + joint.mimics[0].value, ratio, offset)
