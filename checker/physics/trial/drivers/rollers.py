"""Mecanum and omni drives: wheels with rollers, which are taken as ideal.

A wheel with rollers slips without friction across the axes of those that touch the ground. Seen
from above, those of the four Mecanum wheels form a rhombus where they touch; those of an omni wheel
lie along its way. A collision shape has no rollers: they are where the kind of drive puts them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec.structs import replace

from checker.formats.friction import FrictionReader
from checker.model.locomotion.locomotion import DriveKind, Locomotion, Side, Wheel, WheelDrive
from checker.model.robot import Robot
from checker.physics.trial.course import (
    angular_command,
    driving_legs,
    full_speed,
    gentle_speed,
    linear_command,
)
from checker.physics.trial.drivers.wheels import driven_wheel, finite_limit, strictest
from checker.physics.trial.mjcf.geoms import MOST
from checker.physics.trial.mjcf.names import clamp
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import Knots, mix_lines

_MECANUM_ANGLE = math.pi / 4
_NOTE = (
    "Its wheels move on ideal rollers: friction acts along their axes alone, as in Gazebo with "
    "<fdir1> and a second coefficient of 0."
)


NOT_ROLLING = (
    "not all of its wheels with rollers, or fewer than three, have a place and a level axis"
)
_FEWEST = 3
_LIES = 0.1
"""Cosine between an axis that lies and the vertical, at most."""


def can_roll(drive: WheelDrive) -> bool:
    """Return whether wheels determine how the robot moves: with fewer, it would turn on its own."""
    placed = [wheel for wheel in drive.wheels if wheel.centre and wheel.axis]
    lie = all(abs(wheel.axis[2]) <= _LIES for wheel in placed if wheel.axis)
    return len(drive.wheels) == len(placed) >= _FEWEST and lie and drive.wheel_radius.value > 0.0


def plan_rollers(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot on wheels with rollers; it turns in place."""
    drive = locomotion.wheel_drives[0]
    middle = _middle(drive.wheels)
    ways = {
        wheel.joint.scoped_name: _ways(locomotion.kind, drive, wheel, middle)
        for wheel in drive.wheels
    }
    linear, angular = strictest((drive,))
    arm = max(abs(turned) for _, turned in ways.values())
    fastest = min(angular.fastest, full_speed(linear) / arm) if arm > 0.0 else angular.fastest
    legs = driving_legs(linear, (0.0, gentle_speed(fastest)), angular)
    commands = linear_command(legs, linear), angular_command(legs, angular)
    radius, reader = drive.wheel_radius.value, FrictionReader(robot)

    def speed(ahead: float, turned: float) -> Knots:
        return mix_lines(commands, lambda v, w: (ahead * v + turned * w) / radius)

    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=commands[0],
        angular=commands[1],
        speeds={name: speed(*way) for name, way in ways.items()},
        wheels=tuple(
            replace(
                driven_wheel(robot, drive, wheel, reader),
                friction=(_grip(wheel, reader), 0.0),
                rollers=_angle(locomotion.kind, wheel, middle),
            )
            for wheel in drive.wheels
        ),
        speed_limit=finite_limit(linear.fastest),
        acceleration_limit=finite_limit(linear.speeding),
        notes=(_NOTE,),
    )


def _middle(wheels: Sequence[Wheel]) -> tuple[float, float]:
    centres = [wheel.centre for wheel in wheels if wheel.centre is not None]
    count = max(len(centres), 1)
    return sum(x for x, _, _ in centres) / count, sum(y for _, y, _ in centres) / count


def _place(wheel: Wheel, middle: tuple[float, float]) -> tuple[float, float]:
    x, y, _ = wheel.centre or (*middle, 0.0)
    return x - middle[0], y - middle[1]


def _ways(
    kind: DriveKind, drive: WheelDrive, wheel: Wheel, middle: tuple[float, float]
) -> tuple[float, float]:
    """Return how far a wheel rolls when the robot moves a metre ahead, and turns one radian.

    Which way an omni wheel points is the model's, the distance to the middle is the controller's.
    """
    x, y = _place(wheel, middle)
    arm = drive.turning_arm.value if drive.turning_arm is not None else None
    if kind is DriveKind.MECANUM:
        arm = abs(x) + abs(y) if arm is None else arm
        return 1.0, -arm if wheel.side is Side.LEFT else arm
    along, across, _ = wheel.axis or (0.0, 1.0, 0.0)
    outwards = along * x + across * y
    arm = math.hypot(x, y) if arm is None else arm
    return across, -math.copysign(arm, outwards)


def _angle(kind: DriveKind, wheel: Wheel, middle: tuple[float, float]) -> float:
    """Return the angle from a wheel's way to the axes of its rollers, rad."""
    x, y = _place(wheel, middle)
    return -math.copysign(_MECANUM_ANGLE, x * y) if kind is DriveKind.MECANUM else 0.0


def _grip(wheel: Wheel, reader: FrictionReader) -> float:
    """Return the coefficient of friction along the rollers: the largest that the file states."""
    shapes = ((link, shape) for link in wheel.body for shape in link.collisions)
    stated = (reader.friction_of(*each) for each in shapes)
    numbers = [it.value for each in stated for it in (each.first, each.second) if it is not None]
    return clamp(max(numbers, default=1.0), 0.0, MOST, 1.0)
