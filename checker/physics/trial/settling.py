"""Settling of a robot before it is driven."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from checker.physics.trial.trial import Trial

SETTLE_LIMITS: Mapping[str, float] = {
    "settle_drop": 0.1,
    "settle_rise": 0.05,
    "settle_shift": 0.1,
    "settle_tilt": 0.26,
    "settle_speed": 0.05,
    "rest_penetration": 0.05,
}
"""The most that a robot may move without a command: in m, rad and m/s, as the figures are."""

_VERBS = {
    "settle_drop": "drops",
    "settle_rise": "jumps up",
    "settle_shift": "slides",
    "rest_penetration": "sinks into the ground by",
}


def excess_figures(
    trial: Trial, limits: Mapping[str, float] = SETTLE_LIMITS
) -> Iterator[tuple[str, str]]:
    """Yield the figures that are beyond their limits, each with what the robot does.

    Args:
        trial: What was measured.
        limits: The limits by the names of figures.
    """
    for name, limit in limits.items():
        value = trial.value(name)
        if value is None or value <= limit:
            continue
        if name == "settle_tilt":
            symptom = f"tilts by {math.degrees(value):.0f}° (at most {math.degrees(limit):.0f}°)"
        elif name == "settle_speed":
            symptom = f"still moves at {value:.2g} m/s (at most {limit:g} m/s)"
        else:
            symptom = f"{_VERBS[name]} {value:.3g} m (at most {limit:g} m)"
        yield name, symptom


def unsettled_reason(trial: Trial) -> str:
    """Return why the figures of the drive are not valid; empty for a robot that came to rest."""
    return (
        "the robot does not come to rest before it is driven" if any(excess_figures(trial)) else ""
    )
