"""Wheels that an autopilot, or a node beside controllers of single joints, turns joint by joint.

What turns them knows one joint each; which wheels belong together, and how far apart they are, only
the autopilot knows. It is set up for the robot, so figures are those of the model, and a
robot is driven where these leave no doubt: wheels in pairs whose axes point to the left.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.record import Record
from checker.model.components import Joint, Plugin
from checker.model.controllers import Controller
from checker.model.locomotion.locomotion import MotionLimits, Side, Wheel, WheelDrive
from checker.model.locomotion.wheels import WheelReader
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot

_TURNS, _PLACES = "JointController", "JointPositionController"
_AUTOPILOT = "ArduPilotPlugin"
_FORWARDS = "ForwardCommandController"
_ALONG = math.cos(math.radians(1))
"""Cosine of the angle up to which an axis points as it should."""
_NEAR = 0.1
"""Share of a wheel's radius by which the places of a pair may differ."""
_ALIKE = 0.01
"""Share by which the radii of wheels may differ."""


_MOST = 64
"""Wheels that are put together in pairs; each is compared with all others."""


class CommandedWheels(Record, eq=False):
    """Wheels that are turned one by one.

    Attributes:
        drive: The drive that they form; None if that is not certain.
        doubt: The reason why not, as the end of a sentence; empty if it is, and without such
            wheels.
    """

    drive: WheelDrive | None = None
    doubt: str = ""


def commanded_wheels(robot: Robot) -> CommandedWheels:
    """Return the wheels that plugins turn one by one, by a speed."""
    commanded = list(_commanded(robot, _TURNS, "VELOCITY"))
    if not commanded:
        return CommandedWheels()
    reader = WheelReader(robot)
    knuckles = reader.knuckles(joint for joint, _ in _steering(robot))
    called = {link.scoped_name for link in robot.wheels}
    named = (
        (it, reader.wheel_below(joint, Side.LEFT, knuckles, name)) for it, joint, name in commanded
    )
    turned = {
        wheel.joint: (mover, wheel)
        for mover, wheel in named
        if wheel is not None and wheel.radius is not None and wheel.link.scoped_name in called
    }
    if not turned:
        return CommandedWheels()
    mover, _ = next(iter(turned.values()))
    wheels = [wheel for _, wheel in turned.values()]
    if doubt := _doubt(wheels):
        return CommandedWheels(doubt=doubt)
    drive = _drive(robot, mover, _sided(wheels))
    if drive.steering and drive.wheel_base is None:
        return CommandedWheels(doubt="its wheels do not form one steered and one fixed axle")
    return CommandedWheels(drive)


def _commanded(
    robot: Robot, kind: str, control: str
) -> Iterator[tuple[Plugin | Controller, Joint, Located[str]]]:
    """Yield what moves joints in a way, with the joint and its name there."""
    movers: list[tuple[Plugin | Controller, Located[str]]] = [*_by_plugins(robot, kind, control)]
    for mover, name in (*movers, *_by_controllers(robot, control)):
        scoped = mover.scoped(name.value) if isinstance(mover, Plugin) else name.value
        joint = robot.joints_by_name.get(scoped)
        if joint is not None:
            yield mover, joint, name


def _by_controllers(robot: Robot, control: str) -> Iterator[tuple[Controller, Located[str]]]:
    """Yield the joints that controllers of single joints, or of several alike, command."""
    kinds = {
        f"Joint{control.capitalize()}Controller",
        f"JointGroup{control.capitalize()}Controller",
    }
    for controller in robot.controllers:
        forwarded = (text.value.upper() for text in controller.texts("interface_name"))
        if controller.class_name in kinds or (
            controller.class_name == _FORWARDS and control in forwarded
        ):
            yield from ((controller, name) for name in controller.texts("joint", "joints"))


def _by_plugins(robot: Robot, kind: str, control: str) -> Iterator[tuple[Plugin, Located[str]]]:
    """Yield the joints that plugins of a class move, and those of an autopilot's own plugin."""
    for plugin in robot.plugins:
        if plugin.class_name == kind:
            yield from ((plugin, name) for name in plugin.at("joint_name"))
        elif plugin.class_name == _AUTOPILOT:
            for channel in plugin.element.all("control"):
                how, name = channel.child("type"), channel.child("jointName")
                if how is not None and name is not None and how.text.value.upper() == control:
                    yield plugin, name.text


def _steering(robot: Robot) -> Iterator[tuple[Joint, Side]]:
    """Yield joints that are put in place and turn about an axis that points up."""
    for _, joint, _ in _commanded(robot, _PLACES, "POSITION"):
        axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
        if axis is not None and axis[2] >= _ALONG:
            pose = robot.pose_of_joint(joint)
            right = pose is not None and pose.translation[1] < 0.0
            yield joint, Side.RIGHT if right else Side.LEFT


def _doubt(wheels: Sequence[Wheel]) -> str:
    """Return the reason why it is not certain how wheels drive the robot; empty if it is."""
    if len(wheels) > _MOST:
        return f"it has more than {_MOST} wheels"
    if any(wheel.axis is None or wheel.axis[1] < _ALONG for wheel in wheels):
        return "the axes of its wheels do not all point to the left"
    centres = [wheel.centre for wheel in wheels if wheel.centre is not None]
    radii = [wheel.radius for wheel in wheels if wheel.radius is not None]
    near = _NEAR * min(radii)
    if max(radii) - min(radii) > _ALIKE * min(radii):
        return "its wheels are of different sizes"
    middle = _middle([y for _, y, _ in centres])
    for x, y, z in centres:
        opposite = (x, 2 * middle - y, z)
        alone = all(math.dist(opposite, other) > near for other in centres)
        if len(centres) < len(wheels) or alone or abs(y - middle) <= near:
            return "its wheels are not in pairs"
    return ""


def _middle(numbers: Sequence[float]) -> float:
    return (min(numbers) + max(numbers)) / 2 if numbers else 0.0


def _sided(wheels: Sequence[Wheel]) -> tuple[Wheel, ...]:
    middle = _middle([wheel.centre[1] for wheel in wheels if wheel.centre is not None])
    return tuple(
        replace(wheel, side=Side.RIGHT if wheel.centre and wheel.centre[1] < middle else Side.LEFT)
        for wheel in wheels
    )


def _drive(robot: Robot, mover: Plugin | Controller, wheels: tuple[Wheel, ...]) -> WheelDrive:
    """Return the drive of wheels in pairs; where some steer, all of a side turn alike."""
    centres = [wheel.centre for wheel in wheels if wheel.centre is not None]
    width = max(y for _, y, _ in centres) - min(y for _, y, _ in centres)
    steering = _of_wheels(robot, wheels)
    ahead = [pose.translation[0] for joint, _ in steering if (pose := robot.pose_of_joint(joint))]
    behind = [w.centre[0] for w in wheels if w.steering is None and w.centre is not None]
    on_one_axle = bool(ahead and behind) and max(ahead) - min(ahead) <= _NEAR * abs(
        _middle(ahead) - _middle(behind)
    )
    base = _middle(ahead) - _middle(behind) if on_one_axle else None

    def known(number: float) -> Located[float]:
        return Located(number, mover.span, stated=False)

    return WheelDrive(
        mover,
        wheels,
        # One command steers all wheels, and one turns all of them: the inner wheel cannot be
        # distinguished from the outer one.
        known(0.0 if steering else width),
        known(_middle([wheel.radius for wheel in wheels if wheel.radius is not None])),
        MotionLimits(mover.span),
        MotionLimits(mover.span),
        wheel_base=None if base is None else known(base),
        kingpin_width=known(0.0) if steering else None,
        steering=steering,
        separation_tag="",
        radius_tag="",
    )


def _of_wheels(robot: Robot, wheels: Sequence[Wheel]) -> tuple[tuple[Joint, Side], ...]:
    """Return the joints that steer wheels which stand on the ground, driven or not."""
    driven = {wheel.joint for wheel in wheels}
    called = {link.scoped_name for link in robot.wheels}
    parents = {tie.parent for tie in robot.tree.ties if tie.child in called}
    below = {tie.joint: tie.child for tie in robot.tree.ties}
    return tuple(
        (joint, side)
        for joint, side in _steering(robot)
        if joint not in driven and below.get(joint) in parents
    )
