"""Tracks, commanded as gz-sim's TrackedVehicle does it.

A belt runs at v ∓ ω · separation / 2 / steering_efficiency, within the limits of its
TrackController. On the ground it drives at right angles to the y axis of its link: a belt turns
about that axis, whichever way the link's x axis points.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from checker.model.geometry.transform import Transform, Vector
from checker.model.locomotion.locomotion import Locomotion, Side, Track, TrackedDrive
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.physics.trial.course import (
    angular_command,
    driving_legs,
    full_speed,
    gentle_speed,
    linear_command,
)
from checker.physics.trial.drivers.wheels import joined, stated
from checker.physics.trial.plan import Belt, Plan
from checker.physics.trial.profile import Knots, Limits, mixed
from checker.physics.trial.trial import Leg

_UPRIGHT = 1e-3
"""Length of the y axis seen from above; a belt that turns about the vertical drives nowhere."""


def plan_tracks(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot with TrackedVehicle plugins; all are driven together."""
    drives = locomotion.tracked_drives
    belts = joined([Limits.of(track.limits) for track in locomotion.tracks] or [Limits()])
    linear = joined([belts, *(Limits.of(drive.linear) for drive in drives)])
    angular = joined([Limits.of(drive.angular) for drive in drives])
    legs = driving_legs(linear, (0.0, _turn_rate(drives, linear, angular)), angular)
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=linear_command(legs, linear),
        angular=angular_command(legs, angular),
        belts=tuple(_belts(robot, drives, legs)),
        speed_limit=stated(linear.fastest),
        acceleration_limit=stated(linear.speeding),
    )


def _turn_rate(drives: Sequence[TrackedDrive], linear: Limits, angular: Limits) -> float:
    """Return a turn rate at which no belt runs faster than at full speed ahead, rad/s."""
    arm = max((_arm(drive) for drive in drives), default=0.0)
    by_belts = full_speed(linear) / arm if arm > 0.0 else angular.fastest
    return gentle_speed(min(angular.fastest, by_belts))


def _arm(drive: TrackedDrive) -> float:
    """Return the speed of a belt when the commanded turn rate is 1 rad/s, m/s."""
    efficiency = drive.steering_efficiency.value
    return abs(drive.separation.value / 2 / efficiency) if efficiency else 0.0


def _belts(robot: Robot, drives: Sequence[TrackedDrive], legs: Sequence[Leg]) -> list[Belt]:
    belts: dict[str, Belt] = {}
    for drive in drives:
        for track in drive.tracks:
            name = track.link.scoped_name
            belts.setdefault(name, Belt(name, _forward(robot, track), _speed(drive, track, legs)))
    return list(belts.values())


def _speed(drive: TrackedDrive, track: Track, legs: Sequence[Leg]) -> Knots:
    linear = linear_command(legs, Limits.of(drive.linear))
    angular = angular_command(legs, Limits.of(drive.angular))
    arm = _arm(drive) * (-1 if track.side is Side.LEFT else 1)
    limits = Limits.of(track.limits)
    return mixed((linear, angular), lambda v, w: limits.clamped(v + w * arm))


def _forward(robot: Robot, track: Track) -> Vector:
    """Return the direction in which a belt drives, in the robot's frame."""
    pose = robot.pose_of(track.link.scoped_name) or Transform()
    text = next((each.value for each in track.plugin.at("track_orientation")), "")
    angles = [parse_number(word) for word in text.split()]
    if len(angles) == 3 and None not in angles:
        roll, pitch, yaw = (angle or 0.0 for angle in angles)
        pose = pose @ Transform.from_xyz_rpy((0.0, 0.0, 0.0), (roll, pitch, yaw))
    x, y, _ = pose.rotate((0.0, 1.0, 0.0))
    length = math.hypot(x, y)
    # The cross product of the y axis and the ground's normal.
    return (y / length, -x / length, 0.0) if length > _UPRIGHT else (0.0, 0.0, 0.0)
