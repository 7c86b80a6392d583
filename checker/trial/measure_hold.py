"""Standing: how a robot that does not drive keeps the pose it starts in."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import HOLD
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_END = 0.5
"""Seconds at the end of the leg."""


def measure_hold(motion: Motion) -> Iterator[Measurement]:
    """Measure how far joints, height and attitude leave the pose."""
    import numpy as np

    leg = motion.leg(HOLD)
    if leg is None:
        return
    during, end = motion.during(leg), motion.last(leg, _END)
    sags = np.abs(np.array(motion.run.samples.joints)[end] - motion.run.rig.initial).max(axis=0)
    if sags.size:
        # Of joints that give way alike the first is named, mostly whatever the last digits say.
        worst = int(sags.round(4).argmax())
        yield Measurement("hold_sag", float(sags.max()), motion.run.rig.names[worst])
    heights = motion.position[during][:, 2]
    yield Measurement("hold_sink", float(heights[0] - heights.min()))
    yield Measurement("hold_tilt", float(motion.tilt[end].max()))
