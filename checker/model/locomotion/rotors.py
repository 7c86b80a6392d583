"""Reads rotors and the controller of a multicopter out of their plugins."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from checker.model.components import Plugin
from checker.model.geometry.transform import Vector
from checker.model.locomotion.locomotion import (
    CopterControl,
    MotionLimits,
    Rotor,
    RotorEntry,
)
from checker.model.locomotion.motion_limits import symmetric_limits
from checker.model.values import parse_number, stated_number
from checker.source.text import Located
from checker.source.xml import Element

if TYPE_CHECKING:
    from checker.model.robot import Robot


# What the rotors of a multicopter can do: thrust over weight, and what they can control.


GRAVITY = 9.8
"""m/s², of Gazebo's worlds."""

_LEAST_PIVOT = 1e-3
"""Share of a rotor's own effect from where on effects count as independent: poses are rounded."""


def greatest_thrust(rotor: Rotor) -> float:
    """Return the thrust at full speed, N: motor constant · ω²."""
    return rotor.motor_constant.value * rotor.max_velocity.value * rotor.max_velocity.value


def thrust_to_weight(rotors: Sequence[Rotor], mass: float) -> float | None:
    """Return the thrust of all rotors at full speed over the weight.

    Args:
        rotors: All of the robot.
        mass: The mass of the robot, kilograms.

    Returns:
        None if it is not a number: without rotors, without mass.
    """
    thrust = sum(greatest_thrust(rotor) for rotor in rotors)
    weight = mass * GRAVITY
    if not rotors or not weight > 0 or not math.isfinite(weight) or not math.isfinite(thrust):
        return None
    return thrust / weight


def yaw_imbalance(rotors: Sequence[Rotor]) -> float | None:
    """Return the torque about the vertical at equal speed, as a share of all rotors' torques.

    0 if the directions cancel, 1 when all rotors turn one way; None if one is not known.
    """
    torques = []
    for rotor in rotors:
        if not rotor.direction:
            return None
        constants = rotor.moment_constant.value * rotor.motor_constant.value
        torques.append(rotor.direction * constants)
    total = sum(map(abs, torques))
    return abs(sum(torques)) / total if 0 < total < math.inf else None


def controlled_motions(rotors: Sequence[Rotor]) -> int | None:
    """Return how many of climb, roll, pitch and yaw the rotors command independently, 0 to 4.

    It is the rank of the matrix that yields lift and torques from the rotors' thrusts. None if a
    place or direction is not known.
    """
    places = [rotor.centre for rotor in rotors if rotor.centre is not None]
    if len(places) < len(rotors) or not all(rotor.direction for rotor in rotors):
        return None
    middle = [sum(axis) / len(places) for axis in zip(*places, strict=True)]
    arms = [(x - middle[0], y - middle[1]) for x, y, _ in places]
    reach = max((math.hypot(*arm) for arm in arms), default=0.0) or 1.0
    if not math.isfinite(reach):
        return None
    return _rank(
        [
            [1.0, x / reach, y / reach, float(rotor.direction)]
            for rotor, (x, y) in zip(rotors, arms, strict=True)
        ]
    )


def _rank(rows: list[list[float]]) -> int:
    """Return the rank of a matrix by elimination; its entries are about 1."""
    rank = 0
    for column in range(4):
        best = max(range(rank, len(rows)), key=lambda row: abs(rows[row][column]), default=None)
        if best is None or abs(rows[best][column]) <= _LEAST_PIVOT:
            continue
        rows[rank], rows[best] = rows[best], rows[rank]
        pivot = rows[rank]
        for row in rows[rank + 1 :]:
            factor = row[column] / pivot[column]
            for index in range(column, 4):
                row[index] -= factor * pivot[index]
        rank += 1
    return rank


_DIRECTIONS = {"ccw": 1, "cw": -1}

# Defaults of the gz-sim system MulticopterMotorModel.
_MOTOR_CONSTANT = 8.54858e-06
_MOMENT_CONSTANT = 0.016
_MAX_VELOCITY = 838.0


def read_rotor(robot: Robot, plugin: Plugin) -> Rotor:
    """Read a MulticopterMotorModel."""
    name = _text(plugin, "jointName")
    joint = robot.joints_by_name.get(plugin.scoped(name.value))
    link = robot.links_by_name.get(plugin.scoped(_text(plugin, "linkName").value))
    centre: Vector | None = None
    axis: Vector | None = None
    if joint is not None:
        pose = robot.pose_of_joint(joint)
        centre = None if pose is None else pose.translation
        axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
    return Rotor(
        plugin,
        name,
        joint,
        link,
        plugin.number("motorNumber"),
        _DIRECTIONS.get(_text(plugin, "turningDirection").value.lower(), 0),
        _number_or(plugin, "motorConstant", _MOTOR_CONSTANT),
        _number_or(plugin, "momentConstant", _MOMENT_CONSTANT),
        _number_or(plugin, "maxRotVelocity", _MAX_VELOCITY),
        centre,
        axis,
    )


def read_copter(plugin: Plugin) -> CopterControl:
    """Read a MulticopterVelocityControl."""
    rotors = (
        rotor
        for holder in plugin.element.all("rotorConfiguration")
        for rotor in holder.all("rotor")
    )
    return CopterControl(
        plugin,
        tuple(_entry(rotor) for rotor in rotors),
        _limits(plugin, "maximumLinearVelocity", "maximumLinearAcceleration"),
        _limits(plugin, "maximumAngularVelocity", ""),
    )


def _entry(rotor: Element) -> RotorEntry:
    name = rotor.child("jointName")
    return RotorEntry(
        name.text if name is not None else Located("", rotor.span, stated=False),
        stated_number(rotor, "direction"),
        stated_number(rotor, "forceConstant"),
        stated_number(rotor, "momentConstant"),
        rotor.span,
    )


def _limits(plugin: Plugin, velocity: str, acceleration: str) -> tuple[MotionLimits, ...]:
    """Return the limits along x, y and z."""
    velocities = _vector(plugin, velocity)
    accelerations = _vector(plugin, acceleration) if acceleration else (None, None, None)
    return tuple(
        symmetric_limits(plugin.span, v, a) for v, a in zip(velocities, accelerations, strict=True)
    )


def _vector(plugin: Plugin, tag: str) -> tuple[Located[float] | None, ...]:
    text = _text(plugin, tag)
    numbers = [parse_number(word) for word in text.value.split()[:3]]
    numbers += [None] * (3 - len(numbers))
    return tuple(None if n is None else Located(n, text.span) for n in numbers)


def _number_or(plugin: Plugin, path: str, default: float) -> Located[float]:
    return plugin.number(path) or Located(default, plugin.span, stated=False)


def _text(plugin: Plugin, tag: str) -> Located[str]:
    return next(plugin.at(tag), Located("", plugin.span, stated=False))
