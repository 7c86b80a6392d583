"""Wheels that controllers of ros2_control drive and steer."""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.model.components import Joint
from checker.model.controllers import Controller
from checker.model.locomotion.locomotion import MotionLimits, Side, Wheel, WheelDrive
from checker.model.locomotion.wheels import WheelReader
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot

_TRACTION = ("traction_joints_names", "rear_wheels_names", "traction_joint_name")
_STEERING = ("steering_joints_names", "front_wheels_names", "steering_joint_name")
_TRACTION_WIDTH = ("traction_track_width", "rear_wheel_track", "wheel_track")
_STEERING_WIDTH = ("steering_track_width", "front_wheel_track")
_OF_WHEELS = ("front_wheel_track", "rear_wheel_track")
"""Humble's widths, those between wheels. Of the steered axle, its controllers do not use them."""
_RADIUS = (
    *("traction_wheels_radius", "traction_wheel_radius"),
    *("rear_wheels_radius", "rear_wheel_radius", "wheel_radius"),
)
_CORNERS = {
    "front_left": Side.LEFT,
    "front_right": Side.RIGHT,
    "rear_right": Side.RIGHT,
    "rear_left": Side.LEFT,
}
STEERING_CLASSES = frozenset(
    f"{kind}Controller"
    for kind in ("AckermannSteering", "BicycleSteering", "TricycleSteering", "Tricycle")
)
_SAME_WAY = 1.0
"""Multiplier of a joint that turns as the one that it mimics."""


def controlled_drives(robot: Robot, reader: WheelReader) -> Iterator[WheelDrive]:
    """Yield what controllers drive on wheels; those without usable figures drive nothing."""
    followers = _followers(robot)
    for controller in robot.controllers:
        read = _DRIVES.get(controller.class_name)
        drive = read(_Named(robot, reader, controller, followers)) if read is not None else None
        if drive is not None and drive.wheels and drive.wheel_radius.value > 0.0:
            yield drive


def without_idle(
    controllers: Sequence[Controller], started: Container[str]
) -> tuple[Controller, ...]:
    """Leave out the drives that nothing starts, if another one of the robot is started.

    Args:
        controllers: The configured controllers.
        started: Names of controllers that launch files mention.
    """
    drives = [each for each in controllers if each.class_name in _DRIVES]
    driving = [each for each in drives if each.name in started]
    idle = [each for each in drives if each not in driving] if driving else []
    return tuple(each for each in controllers if each not in idle)


class _Named:
    """The joints that a controller names, with those that mimic them."""

    def __init__(
        self,
        robot: Robot,
        reader: WheelReader,
        controller: Controller,
        followers: Mapping[str, list[Joint]],
    ) -> None:
        self.robot, self.reader = robot, reader
        self.controller, self.followers = controller, followers

    @property
    def of_ros1(self) -> bool:
        """True if it is a differential drive of ROS 1: it measures what is not stated."""
        return "left_wheel" in self.controller.parameters

    def joints(self, *parameters: str) -> list[Joint]:
        """Return the joints that the first of these parameters names, and those that mimic them."""
        joints: dict[str, Joint] = {}
        for text in self.controller.texts(*parameters):
            joint = self.robot.joints_by_name.get(text.value)
            for found in (joint, *self.followers.get(text.value, ())) if joint else ():
                if found is not None:
                    joints.setdefault(found.scoped_name, found)
        return list(joints.values())

    def wheels(
        self, side: Side, *parameters: str, steering: Iterable[Joint] = ()
    ) -> Iterator[Wheel]:
        """Yield the wheels of joints; one without a collision is left out where others mimic it."""
        knuckles = self.reader.knuckles(steering)
        named = {text.value: text for text in self.controller.texts(*parameters)}
        wheels = []
        for joint in self.joints(*parameters):
            wheel = self.reader.wheel_below(joint, side, knuckles, named.get(joint.name.value))
            if wheel is not None:
                wheels.append(wheel)
        solid = [wheel for wheel in wheels if any(link.collisions for link in wheel.body)]
        yield from solid or wheels

    def side_of(self, joint: Joint) -> Side:
        """Return the side that a joint is on."""
        pose = self.robot.pose_of_joint(joint)
        return Side.RIGHT if pose is not None and pose.translation[1] < 0.0 else Side.LEFT

    def first(self, *parameters: str) -> str:
        """Return the first of these parameters that is a number; empty if none is."""
        stated = (name for name in parameters if self.controller.number(name) is not None)
        return next(stated, "")

    def number(self, parameter: str) -> Located[float]:
        """Return a number; 0 if it is not stated."""
        found = self.controller.number(parameter)
        return found or Located(0.0, self.controller.span, stated=False)

    def limits(self, motion: str) -> MotionLimits:
        """Return the limits of `linear.x` or `angular.z`; a missing minimum mirrors the maximum."""
        return MotionLimits(
            self.controller.span,
            *self._ends(motion, "velocity", "min_velocity"),
            *self._ends(motion, "acceleration", "min_acceleration", "max_deceleration"),
        )

    def _ends(
        self, motion: str, quantity: str, *least: str
    ) -> tuple[Located[float] | None, Located[float] | None]:
        switch = f"{motion}.has_{quantity}_limits"
        if not self.controller.flag(switch, default=not self.of_ros1):
            return None, None
        most = _finite(self.controller.number(f"{motion}.max_{quantity}"))
        lowest = _finite(self.controller.number(*(f"{motion}.{name}" for name in least)))
        if lowest is None and most is not None:
            lowest = Located(-most.value, most.span)
        return lowest, most


def _finite(number: Located[float] | None) -> Located[float] | None:
    return number if number is not None and math.isfinite(number.value) else None


def _followers(robot: Robot) -> dict[str, list[Joint]]:
    """Return the joints that turn as another one does, by its name."""
    followers: dict[str, list[Joint]] = {}
    for joint in robot.joints if robot.controllers else ():
        mimic = joint.element.child("mimic")
        leader = mimic.get("joint") if mimic is not None else None
        if mimic is not None and leader and _alike(mimic.get("multiplier", "1") or "1"):
            followers.setdefault(leader, []).append(joint)
    return followers


def _alike(multiplier: str) -> bool:
    try:
        return float(multiplier) == _SAME_WAY
    except ValueError:
        return False


def _differential(named: _Named) -> WheelDrive:
    left = tuple(named.wheels(Side.LEFT, "left_wheel_names", "left_wheel"))
    right = tuple(named.wheels(Side.RIGHT, "right_wheel_names", "right_wheel"))
    left, right = _turned(named, "left", left), _turned(named, "right", right)
    slips = max(len(left), len(right)) > 1
    tag, separation = "wheel_separation", named.number("wheel_separation")
    radius = named.number("wheel_radius")
    if named.of_ros1 and left and right:
        separation = separation if separation.stated else _distance(left[0], right[0], separation)
        radius = radius if radius.stated else replace(radius, value=left[0].radius or 0.0)
    times = named.controller.number("wheel_separation_multiplier")
    if slips and times is not None and times.value != 1.0:
        tag = "wheel_separation × wheel_separation_multiplier"
        separation = Located(separation.value * times.value, separation.span)
    return WheelDrive(
        named.controller,
        (*left, *right),
        separation,
        radius,
        named.limits("linear.x"),
        named.limits("angular.z"),
        separation_tag=tag,
        slips=slips,
    )


def _turned(named: _Named, side: str, wheels: tuple[Wheel, ...]) -> tuple[Wheel, ...]:
    """Return the wheels of a side, turned against their axes where their radius is negative."""
    times = named.controller.number(f"{side}_wheel_radius_multiplier")
    if times is None or times.value >= 0.0:
        return wheels
    return tuple(replace(wheel, is_reversed=True) for wheel in wheels)


def _distance(left: Wheel, right: Wheel, unstated: Located[float]) -> Located[float]:
    """Return the distance of two wheels, which diff_drive_controller of ROS 1 takes itself."""
    if left.centre is None or right.centre is None:
        return unstated
    return replace(unstated, value=math.dist(left.centre, right.centre))


def _steered(named: _Named) -> WheelDrive:
    """Return a drive of the steering controllers; the rear wheels may be those that steer."""
    front = named.controller.flag("front_steering", default=True)

    def names(*parameters: str) -> tuple[str, ...]:
        return parameters if front else tuple(map(_other_end, parameters))

    joints = named.joints(*names(*_STEERING))
    wheels = named.wheels(Side.LEFT, *names(*_TRACTION), steering=joints)
    radius = named.first(*names(*_RADIUS))
    width = named.first(*names(*_TRACTION_WIDTH))
    steered = named.first(*names(*_STEERING_WIDTH)) or width
    span = named.controller.span
    # One wheel that steers turns about the middle, as that of a tricycle.
    pair = bool(width) and len(joints) > 1
    return WheelDrive(
        named.controller,
        tuple(replace(wheel, side=named.side_of(wheel.joint)) for wheel in wheels),
        named.number(width),
        named.number(radius),
        MotionLimits(span),
        MotionLimits(span),
        wheel_base=named.controller.number("wheelbase"),
        kingpin_width=named.controller.number(*names(*_STEERING_WIDTH), width) if pair else None,
        steering=tuple((joint, named.side_of(joint)) for joint in joints),
        separation_tag=width,
        radius_tag=radius,
        base_tag="wheelbase",
        kingpin_tag="" if steered in _OF_WHEELS else steered,
        slips=False,
    )


def _other_end(parameter: str) -> str:
    """Return the name of the same parameter for the axle at the other end of the robot."""
    if "rear" in parameter:
        return parameter.replace("rear", "front")
    return parameter.replace("front", "rear")


def _mecanum(named: _Named) -> WheelDrive:
    wheels = (
        wheel
        for corner, side in _CORNERS.items()
        for wheel in named.wheels(side, *_corner_names(corner))
    )
    arm = named.controller.number("kinematics.sum_of_robot_center_projection_on_X_Y_axis")
    base, width = (named.controller.number(name) for name in ("wheel_base", "wheel_separation"))
    if arm is None and base is not None and width is not None:
        arm = Located((base.value + width.value) / 2, width.span)
    return _rolling(named, wheels, arm, "kinematics.wheels_radius", "wheel_radius")


def _corner_names(corner: str) -> Iterator[str]:
    """Yield the parameters of a wheel's joint; mecanum controllers of others have the last two."""
    yield f"{corner}_wheel_command_joint_name"
    yield f"{corner}_joint_name"
    yield f"{corner.replace('rear', 'back')}_joint_name"


def _omni(named: _Named) -> WheelDrive:
    wheels = (
        replace(wheel, side=named.side_of(wheel.joint))
        for wheel in named.wheels(Side.LEFT, "wheel_names")
    )
    return _rolling(named, wheels, named.controller.number("robot_radius"), "wheel_radius")


def _rolling(
    named: _Named, wheels: Iterable[Wheel], arm: Located[float] | None, *radius: str
) -> WheelDrive:
    """Return a drive of wheels with rollers."""
    tag = named.first(*radius) or radius[0]
    return WheelDrive(
        named.controller,
        tuple(wheels),
        named.number(""),
        named.number(tag),
        named.limits("linear.x"),
        named.limits("angular.z"),
        separation_tag="",
        radius_tag=tag,
        turning_arm=arm,
    )


_DRIVES: Mapping[str, Callable[[_Named], WheelDrive]] = {
    **dict.fromkeys(STEERING_CLASSES, _steered),
    "DiffDriveController": _differential,
    "MecanumDriveController": _mecanum,
    "OmniWheelDriveController": _omni,
}

DRIVING_CONTROLLERS = frozenset(_DRIVES)
"""Classes of controllers that drive wheels."""
