"""The plan of a robot's trial, by its way of moving."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.formats.urdf.description import joints_with_motor
from checker.model.components import Joint
from checker.model.geometry.transform import Transform, Vector
from checker.model.locomotion.body_drive import body_drives
from checker.model.locomotion.classic import enforces_limits, wheel_torques
from checker.model.locomotion.locomotion import (
    DriveKind,
    Locomotion,
    Rotor,
    RotorEntry,
    Side,
    Track,
    TrackedDrive,
)
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.physics.mass.mechanism import AXES
from checker.physics.trial.course import (
    CLIMB,
    angular_command,
    driving_legs,
    flying_legs,
    full_speed,
    gentle_speed,
    holding_legs,
    linear_command,
)
from checker.physics.trial.drivers.arms import plan_arm
from checker.physics.trial.drivers.not_driven import (
    moved_as_a_whole,
    reason_not_driven,
    reason_not_tried,
)
from checker.physics.trial.drivers.rollers import NOT_ROLLING, can_roll, plan_rollers
from checker.physics.trial.drivers.wheels import (
    finite_limit,
    plan_ackermann,
    plan_wheels,
    strictest_limits,
)
from checker.physics.trial.mjcf.names import clamp
from checker.physics.trial.plan import Belt, Plan, PlannedRotor
from checker.physics.trial.profile import Knots, Limits, mix_lines
from checker.physics.trial.trial import Leg
from checker.source.text import Located

# Tracks, commanded as gz-sim's TrackedVehicle does it.
#
# A belt runs at v ∓ ω · separation / 2 / steering_efficiency, within the limits of its
# TrackController. On the ground it drives at right angles to the y axis of its link: a belt turns
# about that axis, whichever way the link's x axis points.


_UPRIGHT = 1e-3
"""Length of the y axis seen from above; a belt that turns about the vertical drives nowhere."""


def plan_tracks(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot with TrackedVehicle plugins; all are driven together."""
    drives = locomotion.tracked_drives
    belts = strictest_limits(
        [Limits.from_plugin(track.limits) for track in locomotion.tracks] or [Limits()]
    )
    linear = strictest_limits([belts, *(Limits.from_plugin(drive.linear) for drive in drives)])
    angular = strictest_limits([Limits.from_plugin(drive.angular) for drive in drives])
    legs = driving_legs(linear, (0.0, _turn_rate(drives, linear, angular)), angular)
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=linear_command(legs, linear),
        angular=angular_command(legs, angular),
        belts=tuple(_belts(robot, drives, legs)),
        speed_limit=finite_limit(linear.fastest),
        acceleration_limit=finite_limit(linear.speeding),
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
    linear = linear_command(legs, Limits.from_plugin(drive.linear))
    angular = angular_command(legs, Limits.from_plugin(drive.angular))
    arm = _arm(drive) * (-1 if track.side is Side.LEFT else 1)
    limits = Limits.from_plugin(track.limits)
    return mix_lines((linear, angular), lambda v, w: limits.clamp(v + w * arm))


def _forward(robot: Robot, track: Track) -> Vector:
    """Return the direction in which a belt drives, in the robot's frame."""
    pose = robot.pose_of(track.link.scoped_name) or Transform()
    text = next((value.value for value in track.plugin.at("track_orientation")), "")
    angles = [parse_number(word) for word in text.split()]
    if len(angles) == 3 and None not in angles:
        roll, pitch, yaw = (angle or 0.0 for angle in angles)
        pose = pose @ Transform.from_xyz_rpy((0.0, 0.0, 0.0), (roll, pitch, yaw))
    x, y, _ = pose.rotate((0.0, 1.0, 0.0))
    length = math.hypot(x, y)
    # The cross product of the y axis and the ground's normal.
    return (y / length, -x / length, 0.0) if length > _UPRIGHT else (0.0, 0.0, 0.0)


# Multicopters: the rotors as their plugins describe them.
#
# A rotor pushes along the z axis of its link with motorConstant · ω², as gz-sim's
# MulticopterMotorModel. The controller commands rotor speeds by its own forceConstant; where the
# two differ, the thrust is not the commanded one.


def plan_copter(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a copter: it hovers, then climbs."""
    legs = flying_legs()
    climb = next(leg for leg in legs if leg.name == CLIMB)
    top = climb.start + (climb.end - climb.start) / 2
    still = ((0.0, 0.0), (legs[-1].end, 0.0))
    rising = ((climb.start, climb.linear), (top, climb.linear))
    rotors = tuple(_rotors(robot, locomotion))
    without = len(locomotion.rotors) - len(rotors)
    left_out = (
        f"{without} of {len(locomotion.rotors)} rotors have no link or no usable constants, and so "
        "no thrust."
    )
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=((0.0, 0.0), (climb.start, 0.0), *rising, (top, 0.0), (climb.end, 0.0)),
        angular=still,
        places={rotor.joint.scoped_name: still for rotor in locomotion.rotors if rotor.joint},
        rotors=rotors,
        notes=(left_out,) if without else (),
    )


def _rotors(robot: Robot, locomotion: Locomotion) -> Iterator[PlannedRotor]:
    entries = {
        entry.joint_name.value: entry for copter in locomotion.copters for entry in copter.entries
    }
    for rotor in locomotion.rotors:
        planned = _planned(robot, rotor, entries.get(rotor.name.value))
        if planned is not None:
            yield planned


def _planned(robot: Robot, rotor: Rotor, entry: RotorEntry | None) -> PlannedRotor | None:
    pose = robot.pose_of(rotor.link.scoped_name) if rotor.link is not None else None
    constant, fastest = _number(rotor.motor_constant), _number(rotor.max_velocity)
    most = constant * fastest * fastest
    if rotor.link is None or pose is None or not 0.0 < most < math.inf:
        return None
    believed = _number(entry.force_constant) if entry is not None else 0.0
    return PlannedRotor(
        rotor.link.scoped_name,
        pose.translation,
        pose.rotate((0.0, 0.0, 1.0)),
        rotor.direction,
        most,
        constant / believed if believed > 0.0 else 1.0,
        _number(rotor.moment_constant),
    )


def _number(stated: Located[float] | None) -> float:
    return stated.value if stated is not None and math.isfinite(stated.value) else 0.0


# Legged robots, arms, and robots of which no drive is known: they hold the pose they start in.


def plan_hold(robot: Robot, kind: DriveKind) -> Plan:
    """Return the plan of a robot that stands.

    What no plugin moves is held too where no drive is known: some controller will.
    """
    legs = holding_legs()
    held = robot.joints_by_name if kind is DriveKind.NONE else robot.driven_joints
    return Plan(kind=kind.value, legs=legs, places=at_rest(robot, held, legs))


def at_rest(robot: Robot, joints: Iterable[str], legs: tuple[Leg, ...]) -> dict[str, Knots]:
    """Return commands that keep joints where they start, of those that a servo can hold.

    Balls are left out, and what cannot move.
    """
    starts = {name: start_of(robot.joints_by_name[name], held=True) for name in joints}
    return {
        name: ((0.0, start), (legs[-1].end, start))
        for name, start in starts.items()
        if AXES.get(robot.joints_by_name[name].type.value)
    }


_FROM_STOPS = 0.01, 0.05
"""Distance of a held joint from its limits, at most: rad or m, and share of its range. On a limit,
the stop would carry what the motor has to."""


def start_of(joint: Joint, *, held: bool) -> float:
    """Return where a joint starts, rad or m: its initial position, or the nearest within limits."""
    if not joint.axes:
        return 0.0
    axis = joint.axes[0]
    low, high = axis.lower.value, axis.upper.value
    if joint.type.value == "continuous":
        low, high = -math.inf, math.inf
    if not low < high:
        return 0.0
    most, share = _FROM_STOPS
    off = min(most, share * (high - low)) if held else 0.0
    return clamp(axis.initial_position.value, low + off, high - off, 0.0)


def plan_of(robot: Robot) -> Plan:
    """Return the commands of a trial.

    Joints that plugins move otherwise do not move, and of URDF those that have a motor and turn no
    wheel: some controller holds them.
    """
    if body := next(body_drives(robot), None):
        standing = plan_hold(robot, DriveKind.NONE)
        plan = replace(standing, not_driven=moved_as_a_whole(body.name))
    else:
        plan = _of_kind(robot, robot.locomotion)
    turned = {*plan.speeds, *plan.places}
    held = dict.fromkeys((*robot.driven_joints, *_joints_with_motor(robot)))
    others = [name for name in held if name not in turned]
    places = {**plan.places, **at_rest(robot, others, plan.legs)}
    efforts = _efforts(robot, (*plan.speeds, *places))
    limits_act = enforces_limits(robot)
    speeds = {
        name: _within(robot, name, line) if limits_act else line
        for name, line in plan.speeds.items()
    }
    starts = {
        name: places[name][0][1] if name in places else start_of(joint, held=False)
        for name, joint in robot.joints_by_name.items()
    }
    elsewhere = {name: start for name, start in starts.items() if start}
    return replace(
        plan,
        speeds=speeds,
        places=places,
        starts=elsewhere,
        efforts=efforts,
        limits_act=limits_act,
        notes=(*plan.notes, *_stated_starts(robot, elsewhere)),
    )


def _stated_starts(robot: Robot, starts: Mapping[str, float]) -> Iterator[str]:
    """Yield a sentence about the joints that start where the file states."""
    stated = [
        f"{joint.name.value} {starts[name]:g}"
        for name, joint in robot.joints_by_name.items()
        if name in starts and joint.axes[0].initial_position.stated
    ]
    if stated:
        rest = f", and {len(stated) - _NAMED} more" if len(stated) > _NAMED else ""
        named = ", ".join(stated[:_NAMED]) + rest
        yield f"Joints start at the file's initial positions, within limits (rad or m): {named}."


_NAMED = 8
"""Joints in a sentence, at most."""


def _within(robot: Robot, name: str, speeds: Knots) -> Knots:
    """Return the speeds of a joint that its velocity limit allows, as DART and ros2_control do."""
    joint = robot.joints_by_name.get(name)
    most = joint.axes[0].velocity.value if joint is not None and joint.axes else math.inf
    if not 0.0 <= most < math.inf:
        return speeds
    return mix_lines((speeds,), Limits(-most, most).clamp, step=_CLIPPED_SECONDS)


_CLIPPED_SECONDS = 0.05
"""Time between corners of a line that a limit clips."""


def _joints_with_motor(robot: Robot) -> Iterator[str]:
    wheels = {link.name.value for link in robot.wheels}
    for name in joints_with_motor(robot):
        joint = robot.joints_by_name.get(name)
        if joint is not None and joint.child.value not in wheels:
            yield name


def _of_kind(robot: Robot, locomotion: Locomotion) -> Plan:
    kind = locomotion.kind
    if kind is DriveKind.MULTICOPTER:
        return plan_copter(robot, locomotion)
    if kind is DriveKind.TRACKED and any(drive.tracks for drive in locomotion.tracked_drives):
        return plan_tracks(robot, locomotion)
    steers = any(drive.steering for drive in locomotion.drives)
    has_wheels = any(drive.wheels for drive in locomotion.drives)
    if kind is DriveKind.ACKERMANN and has_wheels and steers:
        return plan_ackermann(robot, locomotion)
    if kind in (DriveKind.DIFFERENTIAL, DriveKind.SKID_STEER) and has_wheels:
        return plan_wheels(robot, locomotion)
    if kind in (DriveKind.MECANUM, DriveKind.OMNI) and can_roll(locomotion.wheel_drives[0]):
        return plan_rollers(robot, locomotion)
    return _standing(robot, locomotion)


def _standing(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot that stands: what moves its joints, or why it is not driven."""
    kind = locomotion.kind
    plan = plan_hold(robot, kind)
    if kind is DriveKind.NONE and not reason_not_tried(robot, locomotion):
        moving = plan_arm(robot, plan)
        if moving is not None:
            return moving
    if kind in (DriveKind.LEGGED, DriveKind.NONE):
        return replace(plan, not_driven=reason_not_driven(robot, locomotion))
    if kind in (DriveKind.MECANUM, DriveKind.OMNI):
        return replace(plan, not_driven=NOT_ROLLING)
    what = "steer" if kind is DriveKind.ACKERMANN and locomotion.wheels else "drive"
    return replace(plan, not_driven=f"its plugins {what} no part of the model")


def _efforts(robot: Robot, joints: Iterable[str]) -> dict[str, float]:
    """Return the effort limits of joints, N·m or N: those of their plugin, or that they state."""
    limits: dict[str, float] = {}
    torques = wheel_torques(robot)
    for name in joints:
        joint = robot.joints_by_name.get(name)
        effort = joint.axes[0].effort.value if joint is not None and joint.axes else 0.0
        if name in torques:
            effort = torques[name][1].value
        if 0.0 < effort < math.inf:
            limits[name] = effort
    return limits
