"""Energy: what is not driven must not gain any."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import SETTLE, STOP_DRIVE, STOP_TURN
from checker.trial.motion import Motion
from checker.trial.trial import Leg, Measurement

_HEIGHT = 0.1
"""Metres: the unit is the energy that lifts the robot by this."""
_AFTER_STOP = 0.5
"""Seconds at the end of a stop, when the wheels stand."""


def measure_energy(motion: Motion) -> Iterator[Measurement]:
    """Measure the largest gain while a robot is not driven."""
    import numpy as np

    energy = np.array(motion.run.samples.energy)
    stretches = []
    for name in (SETTLE, STOP_DRIVE, STOP_TURN):
        leg = motion.leg(name)
        if leg is not None:
            stretches.append(_undriven(motion, leg))
    gains = [
        float((energy[each] - np.minimum.accumulate(energy[each])).max()) for each in stretches
    ]
    if gains and motion.weight > 0.0:
        yield Measurement("energy_gain", max(gains) / (motion.weight * _HEIGHT))


def _undriven(motion: Motion, leg: Leg) -> slice:
    return motion.during(leg) if leg.name == SETTLE else motion.last(leg, _AFTER_STOP)
