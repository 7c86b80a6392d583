"""What the rotors of a multicopter can do: thrust over weight, and what they can control."""

from __future__ import annotations

import math
from collections.abc import Sequence

from checker.model.locomotion import Rotor

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
        mass: Of the robot, kilograms.

    Returns:
        None where it is not a number: without rotors, without mass.
    """
    thrust = sum(greatest_thrust(rotor) for rotor in rotors)
    weight = mass * GRAVITY
    if not rotors or not weight > 0 or not math.isfinite(weight) or not math.isfinite(thrust):
        return None
    return thrust / weight


def yaw_imbalance(rotors: Sequence[Rotor]) -> float | None:
    """Return the torque about the vertical at equal speed, as a share of all rotors' torques.

    0 when the directions cancel, 1 when all rotors turn one way; None where one is not known.
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

    It is the rank of the matrix that yields lift and torques from the rotors' thrusts. None where a
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
            for each in range(column, 4):
                row[each] -= factor * pivot[each]
        rank += 1
    return rank
