"""Legged robots, arms, and robots of which no drive is known: they hold the pose they start in."""

from __future__ import annotations

from collections.abc import Iterable

from checker.dynamics.motion import AXES
from checker.model.locomotion import DriveKind
from checker.model.robot import Robot
from checker.trial.course import holding_legs
from checker.trial.plan import Plan
from checker.trial.profile import Knots
from checker.trial.trial import Leg


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
