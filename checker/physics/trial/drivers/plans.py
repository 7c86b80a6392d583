"""The plan of a robot's trial, by its way of moving."""

from __future__ import annotations

import math
from collections.abc import Iterable

from msgspec.structs import replace

from checker.model.locomotion.locomotion import DriveKind, Locomotion
from checker.model.robot import Robot
from checker.physics.mass.joint_motion import AXES
from checker.physics.trial.course import holding_legs
from checker.physics.trial.drivers.ackermann import plan_ackermann
from checker.physics.trial.drivers.copter import plan_copter
from checker.physics.trial.drivers.tracks import plan_tracks
from checker.physics.trial.drivers.wheels import plan_wheels
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import Knots
from checker.physics.trial.trial import Leg

# Legged robots, arms, and robots of which no drive is known: they hold the pose they start in.


def plan_hold(robot: Robot, kind: DriveKind) -> Plan:
    """Return the plan of a robot that stands.

    What no plugin moves is held too where no drive is known: some controller will.
    """
    legs = holding_legs()
    held = robot.joints_by_name if kind is DriveKind.NONE else robot.driven_joints
    return Plan(kind=kind.value, legs=legs, places=at_rest(robot, held, legs))


def at_rest(robot: Robot, joints: Iterable[str], legs: tuple[Leg, ...]) -> dict[str, Knots]:
    """Return commands that keep joints where they are, of those that a servo can hold.

    Balls are left out, and what cannot move.
    """
    still = ((0.0, 0.0), (legs[-1].end, 0.0))
    return {name: still for name in joints if AXES.get(robot.joints_by_name[name].type.value)}


def plan_of(robot: Robot) -> Plan:
    """Return what a robot shall do in its trial; joints that plugins move otherwise stand still."""
    plan = _of_kind(robot, robot.locomotion)
    turned = {*plan.speeds, *plan.places}
    others = [name for name in robot.driven_joints if name not in turned]
    places = {**plan.places, **at_rest(robot, others, plan.legs)}
    efforts = _efforts(robot, (*plan.speeds, *places))
    return replace(plan, places=places, efforts=efforts)


def _of_kind(robot: Robot, locomotion: Locomotion) -> Plan:
    kind = locomotion.kind
    if kind is DriveKind.MULTICOPTER:
        return plan_copter(robot, locomotion)
    if kind is DriveKind.TRACKED and any(drive.tracks for drive in locomotion.tracked_drives):
        return plan_tracks(robot, locomotion)
    steers = any(drive.steering for drive in locomotion.wheel_drives)
    if kind is DriveKind.ACKERMANN and locomotion.wheels and steers:
        return plan_ackermann(robot, locomotion)
    if kind in (DriveKind.DIFFERENTIAL, DriveKind.SKID_STEER) and locomotion.wheels:
        return plan_wheels(locomotion)
    return _standing(robot, locomotion)


def _standing(robot: Robot, locomotion: Locomotion) -> Plan:
    """Return the plan of a robot that is not driven, and say why if it has a drive."""
    kind = locomotion.kind
    plan = plan_hold(robot, kind)
    if kind in (DriveKind.LEGGED, DriveKind.NONE):
        return plan
    if kind is DriveKind.MECANUM:
        return replace(plan, notes=("Mecanum wheels roll on rollers, which are not simulated.",))
    what = "steer" if kind is DriveKind.ACKERMANN and locomotion.wheels else "drive"
    return replace(plan, not_driven=f"its plugins {what} nothing that the model has")


def _efforts(robot: Robot, joints: Iterable[str]) -> dict[str, float]:
    """Return the effort limits that joints state, N·m or N."""
    limits: dict[str, float] = {}
    for name in joints:
        joint = robot.joints_by_name.get(name)
        effort = joint.axes[0].effort.value if joint is not None and joint.axes else 0.0
        if 0.0 < effort < math.inf:
            limits[name] = effort
    return limits
