"""Turning in place, or on a circle with Ackermann steering, against what the contacts predict."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.trial.course import SETTLE, TURN
from checker.trial.ground import footing, middle
from checker.trial.motion import Motion
from checker.trial.profile import value_at
from checker.trial.trial import Leg, Measurement
from checker.trial.turn_prediction import predicted_twist

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_STEADY = 1.5
"""Seconds at the end of the leg: the ramp is over, and loads and rates are averaged."""
_AT_REST = 0.5
_LEAST = 1e-3
"""rad/s; slower is no turn, and nothing is divided by it."""


def measure_turn(motion: Motion) -> Iterator[Measurement]:
    """Measure the turn, and where the centre of mass lies that governs it."""
    centre = _centre_of_wheels(motion)
    if centre is not None:
        front, side = _centre_of_mass(motion) - centre
        yield Measurement("com_offset_front", float(front))
        yield Measurement("com_offset_side", float(side))
    leg = motion.leg(TURN)
    if leg is None:
        return
    steady = motion.last(leg, _STEADY)
    rate = float(motion.spin[steady, 2].mean())
    commands = [value_at(motion.plan.angular, time) for time in motion.time[steady]]
    commanded = sum(commands) / len(commands)
    yield Measurement("yaw_rate", rate)
    if abs(commanded) > _LEAST:
        yield Measurement("yaw_ratio", float(rate / commanded))
    twist = predicted_twist(footing(motion, motion.touches(leg, _STEADY)))
    if twist is not None:
        yield Measurement("yaw_predicted", float(twist[2]))
        if abs(twist[2]) > _LEAST:
            yield Measurement("yaw_of_predicted", rate / float(twist[2]))
    if centre is not None and motion.plan.turns_in_place:
        yield Measurement("turn_drift", _drift(motion, leg, centre))
        if twist is not None:
            yield Measurement("turn_drift_explained", _explained(leg, twist, centre))


def _centre_of_wheels(motion: Motion) -> Array | None:
    leg = motion.leg(SETTLE)
    return middle(motion, motion.touches(leg, _AT_REST)) if leg is not None else None


def _centre_of_mass(motion: Motion) -> Array:
    import numpy as np

    leg = motion.leg(SETTLE)
    rest = motion.last(leg, _AT_REST) if leg is not None else slice(0, 1)
    centre: Array = np.array(motion.run.samples.centre[rest]).mean(axis=0)[:2]
    return centre


def _drift(motion: Motion, leg: Leg, centre: Array) -> float:
    """Return how far the middle of the wheels comes from where it was, metres."""
    import numpy as np

    during = motion.during(leg)
    places = motion.position[during] + motion.rotation[during] @ np.array((*centre, 0.0))
    return float(np.hypot(*(places - places[0])[:, :2].T).max())


def _explained(leg: Leg, twist: Array, centre: Array) -> float:
    """Return how far the middle of the wheels comes at a steady twist, metres: on a circle."""
    x, y = float(centre[0]), float(centre[1])
    vx, vy, rate = (float(each) for each in twist)
    speed = math.hypot(vx - rate * y, vy + rate * x)
    seconds = leg.end - leg.start
    if abs(rate) * seconds < _LEAST:
        return speed * seconds
    radius, angle = speed / abs(rate), abs(rate) * seconds
    return 2 * radius * math.sin(min(angle, math.pi) / 2)
