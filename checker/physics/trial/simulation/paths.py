"""The path on which all joints of an arm move together: seeded poses, at best without overlaps."""

from __future__ import annotations

import math
from collections.abc import Mapping
from zlib import crc32

from msgspec.structs import replace

from checker.physics.trial.course import CORNERS, TOGETHER
from checker.physics.trial.mjcf.scene import GROUND
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import Knots, smoothed
from checker.physics.trial.simulation.contacts import ContactQuery, Pair
from checker.physics.trial.trial import Leg, Measurement

_TRIES = 4
"""Paths that are looked at; the one with the least overlap counts."""
_LOOK_SECONDS = 0.25
"""Time between poses that are looked at."""


def with_path(query: ContactQuery, plan: Plan) -> tuple[Plan, tuple[Measurement, ...]]:
    """Return a plan with the path of all joints, and the overlaps on it that are new.

    Args:
        query: Of the robot's scene.
        plan: A plan; one that moves no joints stays as it is.
    """
    leg = plan.leg(TOGETHER)
    if leg is None:
        return plan, ()
    tried: list[tuple[Plan, dict[Pair, float]]] = []
    for seed in range(_TRIES):
        path = replace(plan, places={**plan.places, **_path(plan, leg, seed)})
        tried.append((path, _overlaps(query, path, leg)))
        if not tried[-1][1]:
            break
    path, overlaps = min(tried, key=lambda each: max(each[1].values(), default=0.0))
    deepest = sorted(overlaps.items(), key=lambda item: (-item[1], item[0]))
    return path, tuple(Measurement("path_overlap", depth, *pair) for pair, depth in deepest)


def _path(plan: Plan, leg: Leg, seed: int) -> Mapping[str, Knots]:
    seconds = (leg.end - leg.start) / CORNERS
    lines = {}
    for name, move in plan.moves.items():
        line, start = plan.places[name][:-1], plan.places[name][0][1]
        corners = [
            (leg.start + number * seconds, start + _share(seed, number, move.leader) * move.reach)
            for number in range(1, CORNERS)
        ]
        begins = [(leg.start, start)] if line[-1][0] < leg.start else []
        lines[name] = (*line, *begins, *corners, (leg.end, start))
    return lines


def _share(seed: int, corner: int, joint: str) -> float:
    """Return a number from 0 to 1 that looks random: that of a joint depends on no other joint."""
    return crc32(f"{seed} {corner} {joint}".encode()) / 2**32


def _overlaps(query: ContactQuery, plan: Plan, leg: Leg) -> dict[Pair, float]:
    """Return the deepest overlaps on a path of pairs that do not overlap at its start."""
    import numpy as np

    times = np.linspace(leg.start, leg.end, math.ceil((leg.end - leg.start) / _LOOK_SECONDS) + 1)
    places = {name: smoothed(plan.places[name], times)[0] for name in plan.moves}
    deepest: dict[Pair, float] = {}
    already = query.depths(query.pose(plan.starts))
    for number in range(1, len(times) - 1):
        moved = {name: float(place[number]) for name, place in places.items()}
        for pair, depth in query.depths(query.pose({**plan.starts, **moved})).items():
            if pair not in already and GROUND not in pair:
                deepest[pair] = max(deepest.get(pair, 0.0), depth)
    return deepest
