"""Differential and skid-steer drives, commanded as gz-sim's DiffDrive does it.

A wheel turns at (v ∓ ω · separation / 2) / radius about its joint's axis as the file states it,
with the separation and the radius of the plugin: what is wrong in either shows on the course.
"""

from __future__ import annotations

from collections.abc import Sequence

from checker.model.locomotion.locomotion import Locomotion, Side, Wheel, WheelDrive
from checker.physics.trial.course import (
    angular_command,
    driving_legs,
    full_speed,
    gentle_speed,
    linear_command,
)
from checker.physics.trial.plan import DrivenWheel, Plan
from checker.physics.trial.profile import Knots, Limits, mixed
from checker.physics.trial.trial import Leg


def plan_wheels(locomotion: Locomotion) -> Plan:
    """Return the plan of a robot with DiffDrive plugins; several of them are driven together."""
    drives = locomotion.wheel_drives
    linear, angular = strictest(drives)
    legs = driving_legs(linear, (0.0, _turn_rate(drives, linear, angular)), angular)
    speeds: dict[str, Knots] = {}
    wheels: dict[str, DrivenWheel] = {}
    for drive in drives:
        for wheel in drive.wheels:
            name = wheel.joint.scoped_name
            speeds.setdefault(name, _speed(drive, wheel, legs))
            wheels.setdefault(name, driven_wheel(drive, wheel))
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=linear_command(legs, linear),
        angular=angular_command(legs, angular),
        speeds=speeds,
        wheels=tuple(wheels.values()),
        speed_limit=stated(linear.fastest),
        acceleration_limit=stated(linear.speeding),
    )


def strictest(drives: Sequence[WheelDrive]) -> tuple[Limits, Limits]:
    """Return limits of forward and of turning motion that all drives keep."""
    return joined([Limits.of(d.linear) for d in drives]), joined(
        [Limits.of(d.angular) for d in drives]
    )


def joined(limits: Sequence[Limits]) -> Limits:
    """Return the strictest of several limits."""
    return Limits(
        max(each.slowest for each in limits),
        min(each.fastest for each in limits),
        max(each.braking for each in limits),
        min(each.speeding for each in limits),
    )


def stated(limit: float) -> float | None:
    """Return a limit; None for infinity."""
    return limit if limit < float("inf") else None


def driven_wheel(drive: WheelDrive, wheel: Wheel) -> DrivenWheel:
    """Return what the simulation needs to know of a wheel."""
    radius = wheel.radius if wheel.radius is not None else drive.wheel_radius.value
    names = tuple(link.scoped_name for link in wheel.body)
    return DrivenWheel(wheel.joint.scoped_name, names, radius if radius > 0.0 else 0.0)


def _turn_rate(drives: Sequence[WheelDrive], linear: Limits, angular: Limits) -> float:
    """Return a turn rate at which no wheel runs faster than at full speed ahead, rad/s."""
    arm = max((abs(drive.wheel_separation.value) / 2 for drive in drives), default=0.0)
    by_wheels = full_speed(linear) / arm if arm > 0.0 else angular.fastest
    return gentle_speed(min(angular.fastest, by_wheels))


def _speed(drive: WheelDrive, wheel: Wheel, legs: Sequence[Leg]) -> Knots:
    """Return the speed of a wheel over time, rad/s."""
    linear = linear_command(legs, Limits.of(drive.linear))
    angular = angular_command(legs, Limits.of(drive.angular))
    arm = drive.wheel_separation.value / 2 * (-1 if wheel.side is Side.LEFT else 1)
    radius = drive.wheel_radius.value
    return mixed((linear, angular), lambda v, w: (v + w * arm) / radius if radius else 0.0)
