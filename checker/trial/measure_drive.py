"""Driving straight, stopping, and driving at full speed."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import DRIVE, FULL, STOP_DRIVE, STOP_TURN
from checker.trial.motion import Motion
from checker.trial.profile import value_at
from checker.trial.trial import Leg, Measurement

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
    during, steady = motion.during(leg), motion.last(leg, _STEADY)
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
        place = motion.position[motion.during(leg)]
        yield Measurement("stop_distance", float(np.hypot(*(place[-1] - place[0])[:2])))


def _full_speed(motion: Motion, leg: Leg) -> Iterator[Measurement]:
    speeds = motion.forward[motion.during(leg)]
    times = motion.time[motion.during(leg)]
    step = float(times[1] - times[0])
    apart = max(round(_STRETCH / step), 1)
    gained = (speeds[apart:] - speeds[:-apart]) / (apart * step)
    yield Measurement("full_speed", float(motion.forward[motion.last(leg, 0.5)].mean()))
    yield Measurement("full_acceleration", float(gained.max()))
    if motion.plan.speed_limit is not None:
        yield Measurement("full_speed_limit", motion.plan.speed_limit)
    if motion.plan.acceleration_limit is not None:
        yield Measurement("full_acceleration_limit", motion.plan.acceleration_limit)
