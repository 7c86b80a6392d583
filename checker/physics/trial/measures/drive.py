"""Driving straight, stopping, and driving at full speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.physics.trial.course import DRIVE, FULL, SETTLE, STOP_DRIVE, STOP_TURN, TURN
from checker.physics.trial.measures.ground import Footing, footing, middle
from checker.physics.trial.measures.motion import Motion
from checker.physics.trial.profile import value_at
from checker.physics.trial.trial import Leg, Measurement

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# How fast a robot turns when its wheels slip: a quasi-static balance of Coulomb friction.
#
# While it turns steadily, the friction forces at the contact points and their moments add up to
# nothing. The twist (vx, vy, ω) for which they do makes the power of friction Σ grip·|slip| least:
# the sum is convex, so Newton's method finds it, made smooth by less and less.


_SMOOTHING = (1e-1, 1e-2, 1e-3, 1e-4)
"""m/s below which slip counts as creep, one after the other."""
_ROUNDS = 60
_ENOUGH = 1e-10


def predicted_twist(footing: Footing) -> Array | None:
    """Return vx, vy (m/s, of the robot's frame) and ω (rad/s); None if nothing holds it."""
    import numpy as np

    most = footing.grip.max(axis=1)
    if not most.sum() > 0.0:
        return None
    # Lengths near 1 make the Newton steps well scaled.
    arm = max(float(np.abs(footing.points).max()), 1e-6)
    x, y = footing.points.T / arm
    ones, none = np.ones_like(x), np.zeros_like(x)
    # slip = jacobian · twist + slide, with ω in m/s at the arm.
    jacobian = np.stack([np.stack([ones, none, -y], 1), np.stack([none, ones, x], 1)], 1)
    # Where friction has a direction, a slip counts by its share of the largest.
    shares = footing.grip / most[:, None]
    jacobian, slide = jacobian * shares[:, :, None], footing.slide * shares
    grip = most / most.sum()
    twist = np.zeros(3)
    for creep in _SMOOTHING:
        twist = _least_power(jacobian, slide, grip, twist, creep)
    twist[2] /= arm
    return twist if np.isfinite(twist).all() else None


def _least_power(jacobian: Array, slide: Array, grip: Array, twist: Array, creep: float) -> Array:
    """Return the twist of least friction power, by Newton's method with a line search."""
    import numpy as np

    def power(at: Array) -> float:
        slip = jacobian @ at + slide
        return float(grip @ np.sqrt((slip**2).sum(axis=1) + creep**2))

    now = power(twist)
    for _ in range(_ROUNDS):
        slip = jacobian @ twist + slide
        size = np.sqrt((slip**2).sum(axis=1) + creep**2)
        unit = slip / size[:, None]
        turned = jacobian.transpose(0, 2, 1)
        gradient = grip @ (turned @ unit[:, :, None])[:, :, 0]
        across = np.eye(2) - unit[:, :, None] * unit[:, None, :]
        curvature = ((grip / size)[:, None, None] * (turned @ across @ jacobian)).sum(axis=0)
        move = np.linalg.lstsq(curvature, -gradient, rcond=1e-12)[0]
        if -float(gradient @ move) < _ENOUGH * creep:
            break
        share = 1.0
        while share > 1e-6 and power(twist + share * move) > now + 1e-4 * share * gradient @ move:
            share /= 2
        twist = twist + share * move
        now = power(twist)
    return twist


# Turning in place, or on a circle with Ackermann steering, against what the contacts predict.


_STEADY_TURN = 1.5
"""Seconds at the end of the leg: the ramp is over, and loads and rates are averaged."""
_AT_REST = 0.5
_LEAST = 1e-3
"""rad/s; slower is no turn, and nothing is divided by it."""


def measure_turn(motion: Motion) -> Iterator[Measurement]:
    """Measure the turn, and the centre of mass that governs it."""
    centre = _centre_of_wheels(motion)
    if centre is not None:
        front, side = _centre_of_mass(motion) - centre
        yield Measurement("com_offset_front", float(front))
        yield Measurement("com_offset_side", float(side))
    leg = motion.leg(TURN)
    if leg is None:
        return
    steady = motion.last(leg, _STEADY_TURN)
    rate = float(motion.spin[steady, 2].mean())
    commands = [value_at(motion.plan.angular, time) for time in motion.time[steady]]
    commanded = sum(commands) / len(commands)
    yield Measurement("yaw_rate", rate)
    if abs(commanded) > _LEAST:
        yield Measurement("yaw_ratio", float(rate / commanded))
    rollers = any(wheel.rollers is not None for wheel in motion.plan.wheels)
    # What rolls on rollers does not slip in a turn.
    contacts = None if rollers else footing(motion, motion.touches(leg, _STEADY_TURN))
    twist = None if contacts is None else predicted_twist(contacts)
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

    during = motion.samples_during(leg)
    places = motion.position[during] + motion.rotation[during] @ np.array((*centre, 0.0))
    return float(np.hypot(*(places - places[0])[:, :2].T).max())


def _explained(leg: Leg, twist: Array, centre: Array) -> float:
    """Return how far the middle of the wheels comes at a steady twist, metres: on a circle."""
    x, y = float(centre[0]), float(centre[1])
    vx, vy, rate = (float(number) for number in twist)
    speed = math.hypot(vx - rate * y, vy + rate * x)
    seconds = leg.end - leg.start
    if abs(rate) * seconds < _LEAST:
        return speed * seconds
    radius, angle = speed / abs(rate), abs(rate) * seconds
    return 2 * radius * math.sin(min(angle, math.pi) / 2)


_STEADY = 1.0
"""Seconds at the end of a leg, over which a speed is averaged."""
_SHORTEST = 0.01
"""Metres; over a shorter way, what is straight is not known."""
_STRETCH = 0.2
"""Seconds over which an acceleration is averaged."""


def measure_drive(motion: Motion) -> Iterator[Measurement]:
    """Measure the straight drive and what follows it."""
    drive, full = motion.leg(DRIVE), motion.leg(FULL)
    if drive is not None:
        yield from _straight(motion, drive)
    yield from _stops(motion)
    if full is not None:
        yield from _full_speed(motion, full)
    if drive is not None:
        driven = motion.time >= drive.start
        yield Measurement("tilt_max", float(motion.tilt[driven].max()))


def _straight(motion: Motion, leg: Leg) -> Iterator[Measurement]:
    during, steady = motion.samples_during(leg), motion.last(leg, _STEADY)
    commands = [value_at(motion.plan.linear, time) for time in motion.time[steady]]
    commanded = sum(commands) / len(commands)
    if commanded > 0.0:
        yield Measurement("speed_ratio", float(motion.forward[steady].mean() / commanded))
    place = motion.position[during]
    forward, sideways, _ = (place[-1] - place[0]) @ motion.rotation[during][0]
    if abs(forward) > _SHORTEST:
        yield Measurement("path_sideways", float(sideways / forward))
    heading = motion.yaw[during]
    yield Measurement("path_heading", float(heading[-1] - heading[0]))


def _stops(motion: Motion) -> Iterator[Measurement]:
    import numpy as np

    stops = [leg for leg in map(motion.leg, (STOP_DRIVE, STOP_TURN)) if leg is not None]
    left = [
        float(np.linalg.norm(motion.velocity[motion.last(leg, 0.1)], axis=1).mean())
        # A plugin that may brake but gently still commands a speed.
        - abs(value_at(motion.plan.linear, leg.end))
        for leg in stops
    ]
    if left:
        yield Measurement("stop_speed", max(*left, 0.0))
    for leg in stops[:1]:
        place = motion.position[motion.samples_during(leg)]
        yield Measurement("stop_distance", float(np.hypot(*(place[-1] - place[0])[:2])))


def _full_speed(motion: Motion, leg: Leg) -> Iterator[Measurement]:
    speeds = motion.forward[motion.samples_during(leg)]
    times = motion.time[motion.samples_during(leg)]
    step = float(times[1] - times[0])
    apart = max(round(_STRETCH / step), 1)
    gained = (speeds[apart:] - speeds[:-apart]) / (apart * step)
    yield Measurement("full_speed", float(motion.forward[motion.last(leg, 0.5)].mean()))
    yield Measurement("full_acceleration", float(gained.max()))
    if motion.plan.speed_limit is not None:
        yield Measurement("full_speed_limit", motion.plan.speed_limit)
    if motion.plan.acceleration_limit is not None:
        yield Measurement("full_acceleration_limit", motion.plan.acceleration_limit)
