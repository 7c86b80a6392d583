"""Hovering and climbing."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import CLIMB, CLIMB_METRES, HOVER
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_END = 1.0
"""Seconds at the end of a leg."""


def measure_flight(motion: Motion) -> Iterator[Measurement]:
    """Measure what the rotors give, and how the copter hovers and climbs."""
    rotors = motion.plan.rotors
    if rotors and motion.weight > 0.0:
        lift = sum(rotor.most * max(rotor.up[2], 0.0) for rotor in rotors)
        yield Measurement("thrust_to_weight", lift / motion.weight)
    yield from _hover(motion)
    climb, hover = motion.leg(CLIMB), motion.leg(HOVER)
    if climb is not None and hover is not None:
        heights = motion.position[:, 2]
        top, before = heights[motion.last(climb, 0.1)], heights[motion.last(hover, 0.1)]
        yield Measurement("climbed", float((top.mean() - before.mean()) / CLIMB_METRES))


def _hover(motion: Motion) -> Iterator[Measurement]:
    leg = motion.leg(HOVER)
    if leg is None:
        return
    effort = motion.run.hover_effort
    if effort is not None:
        yield Measurement("hover_effort", effort)
    heights = motion.position[motion.during(leg)][:, 2]
    end = motion.last(leg, _END)
    yield Measurement("hover_sink", float(heights[0] - heights[-20:].mean()))
    yield Measurement("hover_tilt", float(motion.tilt[end].max()))
