"""Differential and skid-steer drives, commanded as gz-sim's DiffDrive does it.

A wheel turns at (v ∓ ω · separation / 2) / radius about its joint's axis as the file states it,
with the separation and the radius of the plugin: a fault in either has an effect on the course.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from checker.formats.friction import FrictionReader
from checker.model.controllers import Controller
from checker.model.locomotion.locomotion import Locomotion, Side, Wheel, WheelDrive
from checker.model.robot import Robot
from checker.physics.trial.course import (
    TURN,
    angular_command,
    driving_legs,
    full_speed,
    gentle_speed,
    linear_command,
)
from checker.physics.trial.mjcf.geoms import MOST
from checker.physics.trial.mjcf.names import clamp
from checker.physics.trial.plan import DrivenWheel, Plan
from checker.physics.trial.profile import Knots, Limits, mix_lines
from checker.physics.trial.trial import Leg
from checker.source.text import Located


def plan_wheels(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot with DiffDrive plugins; several of them are driven together."""
    drives = locomotion.drives
    linear, angular = strictest(drives)
    legs = driving_legs(linear, (0.0, _turn_rate(drives, linear, angular)), angular)
    speeds: dict[str, Knots] = {}
    wheels: dict[str, DrivenWheel] = {}
    reader = FrictionReader(robot)
    for drive in drives:
        for wheel in drive.wheels:
            name = wheel.joint.scoped_name
            speeds.setdefault(name, _speed(drive, wheel, legs))
            wheels.setdefault(name, driven_wheel(robot, drive, wheel, reader))
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=linear_command(legs, linear),
        angular=angular_command(legs, angular),
        speeds=speeds,
        wheels=tuple(wheels.values()),
        speed_limit=finite_limit(linear.fastest),
        acceleration_limit=finite_limit(linear.speeding),
    )


def strictest(drives: Sequence[WheelDrive]) -> tuple[Limits, Limits]:
    """Return limits of forward and of turning motion that all drives keep."""
    return strictest_limits([Limits.from_plugin(d.linear) for d in drives]), strictest_limits(
        [Limits.from_plugin(d.angular) for d in drives]
    )


def strictest_limits(limits: Sequence[Limits]) -> Limits:
    """Return the strictest of several limits."""
    return Limits(
        max(limit.slowest for limit in limits),
        min(limit.fastest for limit in limits),
        max(limit.braking for limit in limits),
        min(limit.speeding for limit in limits),
    )


def finite_limit(limit: float) -> float | None:
    """Return a limit; None for infinity."""
    return limit if limit < float("inf") else None


def driven_wheel(
    robot: Robot, drive: WheelDrive, wheel: Wheel, reader: FrictionReader
) -> DrivenWheel:
    """Return what the simulation needs to know of a wheel."""
    radius = wheel.radius if wheel.radius is not None else drive.wheel_radius.value
    names = tuple(link.scoped_name for link in wheel.body)
    friction = _directed_friction(robot, wheel, reader)
    return DrivenWheel(wheel.joint.scoped_name, names, radius if radius > 0.0 else 0.0, friction)


_ALONG = 0.98
"""Cosine between an axle and a friction direction along it: what points elsewhere turns with the
wheel."""


def _directed_friction(
    robot: Robot, wheel: Wheel, reader: FrictionReader
) -> tuple[float, float] | None:
    """Return the friction along the way of a wheel and along its axle, if it has directions."""
    for link in wheel.body:
        for collision in link.collisions:
            friction = reader.friction_of(link, collision)
            pose = robot.pose_of_part(link, collision.pose)
            side, way = friction.first, friction.second
            if not (side and way and friction.direction and wheel.axis and pose):
                continue
            along = pose.rotate(friction.direction)
            cosine = sum(a * b for a, b in zip(along, wheel.axis, strict=True)) / math.hypot(*along)
            if abs(cosine) > _ALONG:
                return clamp(way.value, 0.0, MOST, 1.0), clamp(side.value, 0.0, MOST, 1.0)
    return None


def _turn_rate(drives: Sequence[WheelDrive], linear: Limits, angular: Limits) -> float:
    """Return a turn rate at which no wheel runs faster than at full speed ahead, rad/s."""
    arm = max((abs(drive.wheel_separation.value) / 2 for drive in drives), default=0.0)
    by_wheels = full_speed(linear) / arm if arm > 0.0 else angular.fastest
    return gentle_speed(min(angular.fastest, by_wheels))


def _speed(drive: WheelDrive, wheel: Wheel, legs: Sequence[Leg]) -> Knots:
    """Return the speed of a wheel over time, rad/s."""
    linear = linear_command(legs, Limits.from_plugin(drive.linear))
    angular = angular_command(legs, Limits.from_plugin(drive.angular))
    arm = drive.wheel_separation.value / 2 * (-1 if wheel.side is Side.LEFT else 1)
    radius = drive.wheel_radius.value * (-1 if wheel.is_reversed else 1)
    return mix_lines((linear, angular), lambda v, w: (v + w * arm) / radius if radius else 0.0)


# Ackermann steering, as Gazebo's AckermannSteering does it: from the figures that it is given.
#
# Angles come from its wheel base and kingpin width, wheel rates from wheel separation and radius,
# and no turn is tighter than its steering limit allows; so wrong figures show on the course.


_SHARE_OF_LIMIT = 0.6
"""Share of the steering limit, so that the inner wheel stays within it too."""
_STEERING_SECONDS = 1.0
_USUAL_BASE = 1.0
_USUAL_LIMIT = 0.5
_OUTWARDS = {Side.LEFT: -1.0, Side.RIGHT: 1.0}
"""Sign by side: in a turn to the left, the left wheels have the shorter way."""
_GRID = 0.05
"""Seconds between corners of commands that follow the steering."""


def plan_ackermann(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot whose wheels steer; it turns on a circle."""
    drives = locomotion.drives
    linear, _ = strictest(drives)
    steered = [drive for drive in drives if drive.steering]
    bend = _curvature(robot, steered[0])
    speed = gentle_speed(linear.fastest)
    legs = driving_legs(linear, (speed, speed * bend))
    ahead, curve = linear_command(legs, linear), _curve(legs, bend)
    speeds: dict[str, Knots] = {}
    places: dict[str, Knots] = {}
    wheels: dict[str, DrivenWheel] = {}
    reader = FrictionReader(robot)
    for drive in drives:
        reached = _within_reach(drive, curve)
        speeds |= _speeds(drive, ahead, reached)
        places |= dict(_angles(drive, reached))
        wheels |= {w.joint.scoped_name: driven_wheel(robot, drive, w, reader) for w in drive.wheels}
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=ahead,
        angular=mix_lines((ahead, curve), lambda v, k: v * k, _GRID),
        speeds=speeds,
        places=places,
        wheels=tuple(wheels.values()),
        speed_limit=finite_limit(linear.fastest),
        acceleration_limit=finite_limit(linear.speeding),
        turns_in_place=False,
    )


def _curve(legs: Sequence[Leg], bend: float) -> Knots:
    """Return the curvature over time, 1/m: it comes and goes within the first second of a leg."""
    knots: list[tuple[float, float]] = []
    value = 0.0
    for leg in legs:
        knots.append((leg.start, value))
        value = bend if leg.name == TURN else 0.0
        knots.append((min(leg.start + _STEERING_SECONDS, leg.end), value))
    return tuple(knots)


def _curvature(robot: Robot, drive: WheelDrive) -> float:
    """Return the curvature of the circle, 1/m: well within reach of the steering joints."""
    limits = [_number(drive.steering_limit, _USUAL_LIMIT)]
    for joint, _ in drive.steering:
        for axis in joint.axes[:1]:
            limits += [abs(axis.lower.value), abs(axis.upper.value)]
    limit = min((angle for angle in limits if 0.0 < angle < math.pi / 2), default=_USUAL_LIMIT)
    return math.tan(_SHARE_OF_LIMIT * limit) / _true_base(robot, drive)


def _true_base(robot: Robot, drive: WheelDrive) -> float:
    """Return the distance of the steered axle from the other one in the model, metres."""
    poses = (robot.pose_of_joint(joint) for joint, _ in drive.steering)
    steered = [pose.translation[0] for pose in poses if pose is not None]
    fixed = [w.centre[0] for w in drive.wheels if w.steering is None and w.centre is not None]
    stated = abs(_number(drive.wheel_base, _USUAL_BASE)) or _USUAL_BASE
    if not steered or not fixed:
        return stated
    return abs(sum(steered) / len(steered) - sum(fixed) / len(fixed)) or stated


def _number(stated: Located[float] | None, usual: float) -> float:
    return usual if stated is None or math.isnan(stated.value) else stated.value


def _within_reach(drive: WheelDrive, curve: Knots) -> Knots:
    """Keep a curvature within the tightest that the plugin allows: sin(limit) / wheel base."""
    base = abs(_number(drive.wheel_base, _USUAL_BASE)) or _USUAL_BASE
    limit = min(max(_number(drive.steering_limit, _USUAL_LIMIT), 0.0), math.pi / 2)
    tightest = math.sin(limit) / base
    return mix_lines((curve,), lambda k: max(-tightest, min(k, tightest)), _GRID)


def _speeds(drive: WheelDrive, ahead: Knots, curve: Knots) -> dict[str, Knots]:
    """Return the rates of the wheels: all of a side turn alike, as of a simple differential."""
    radius = drive.wheel_radius.value
    speeds: dict[str, Knots] = {}
    for wheel in drive.wheels:
        arm = _OUTWARDS[wheel.side] * drive.wheel_separation.value / 2
        # A tricycle's wheel that drives and steers has the longer way.
        turned = wheel.steering is not None and isinstance(drive.plugin, Controller)
        base = _number(drive.wheel_base, 0.0) if turned else 0.0

        def speed(v: float, k: float, arm: float = arm, base: float = base) -> float:
            return v * (1.0 + arm * k) * math.hypot(1.0, base * k) / radius if radius else 0.0

        speeds[wheel.joint.scoped_name] = mix_lines((ahead, curve), speed, _GRID)
    return speeds


def _angles(drive: WheelDrive, curve: Knots) -> Iterator[tuple[str, Knots]]:
    """Yield the angles of the steering joints, by the plugin's wheel base and kingpin width."""
    base = _number(drive.wheel_base, _USUAL_BASE)
    for joint, side in drive.steering:
        arm = _OUTWARDS[side] * _number(drive.kingpin_width, 0.0) / 2

        def angle(k: float, arm: float = arm) -> float:
            return math.atan2(base * k, 1.0 + arm * k)

        yield joint.scoped_name, mix_lines((curve,), angle, _GRID)
