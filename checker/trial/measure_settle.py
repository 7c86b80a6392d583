"""Settling: two seconds without command, from 10 mm above the ground."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import SETTLE
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_AT_REST = 0.5
"""Seconds over which what rests is looked at."""


def measure_settle(motion: Motion) -> Iterator[Measurement]:
    """Measure how a robot comes to rest."""
    import numpy as np

    leg = motion.leg(SETTLE)
    if leg is None:
        return
    during, rest = motion.during(leg), motion.last(leg, _AT_REST)
    place = motion.position[during]
    heights = place[:, 2] - place[0, 2]
    yield Measurement("settle_drop", float(-heights.min()))
    yield Measurement("settle_rise", float(heights.max()))
    yield Measurement("settle_shift", float(np.hypot(*(place[-1] - place[0])[:2])))
    yield Measurement("settle_tilt", float(motion.tilt[rest].mean()))
    speeds = np.linalg.norm(motion.velocity[rest], axis=1)
    yield Measurement("settle_speed", float(speeds.mean()))
    deepest = motion.touches(leg, _AT_REST).depth.max(initial=0.0)
    yield Measurement("rest_penetration", float(deepest))
