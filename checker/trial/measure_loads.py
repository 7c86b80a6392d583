"""What the drive wheels carry at rest."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import SETTLE
from checker.trial.ground import loads
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_AT_REST = 1.0
"""Seconds over which loads are averaged: one instant lies."""


def measure_loads(motion: Motion) -> Iterator[Measurement]:
    """Measure each drive wheel's load against an equal share of the weight."""
    leg = motion.leg(SETTLE)
    wheels = motion.plan.wheels
    if leg is None or not motion.weight > 0.0:
        return
    carried = loads(motion.touches(leg, _AT_REST))
    for wheel in wheels:
        load = sum(carried.get(link, 0.0) for link in wheel.links)
        yield Measurement("load_share", load * len(wheels) / motion.weight, wheel.joint)
