"""Multicopters: the rotors as their plugins describe them.

A rotor pushes along the z axis of its link with motorConstant · ω², as gz-sim's
MulticopterMotorModel. The controller asks for rotor speeds that would do by its own forceConstant;
where the two differ, the thrust that comes is not the one it asks for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from checker.model.locomotion.locomotion import Locomotion, Rotor, RotorEntry
from checker.model.robot import Robot
from checker.physics.trial.course import CLIMB, flying_legs
from checker.physics.trial.plan import Plan, PlannedRotor
from checker.source.text import Located


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
        f"{without} of {len(locomotion.rotors)} rotors have no link or no usable constants, "
        "and give no thrust."
    )
    return Plan(
        kind=locomotion.kind.value,
        legs=legs,
        linear=((0.0, 0.0), (climb.start, 0.0), *rising, (top, 0.0), (climb.end, 0.0)),
        angular=still,
        places={each.joint.scoped_name: still for each in locomotion.rotors if each.joint},
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
