"""Starts the trial of a robot in a child process, and keeps what it measures."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from checker.cache import Cache, code_hash, key_of
from checker.confined import NONSENSE, Child, Died, Limits, from_json
from checker.model.robot import Robot
from checker.trial.drivers.planning import plan_of
from checker.trial.scene import build_scene
from checker.trial.trial import Trial
from checker.versions import version_of

TIMESTEP = 0.002
"""Seconds; contacts and servos are tuned to it."""
LIMITS = Limits(seconds=20.0, memory=1_000_000_000)

_KIND = "trial"
_LIBRARIES = ("mujoco", "numpy", "scipy")


@dataclass
class Pending:
    """A trial that is under way, or known already."""

    _cache: Cache
    _key: str = ""
    _child: Child | None = None
    _outcome: Trial | str = ""

    @property
    def known(self) -> bool:
        """Whether nothing needs to be waited for."""
        return self._child is None

    def stop(self) -> None:
        """End the trial, if nobody has waited for it."""
        if self._child is not None:
            self._child.stop()

    def result(self) -> Trial | str:
        """Wait for the trial; else return why there is none, as the end of a sentence."""
        if self._child is not None:
            answer = self._child.answer()
            self._child = None
            self._outcome = self._read(answer)
        return self._outcome

    def _read(self, answer: bytes | Died) -> Trial | str:
        if isinstance(answer, Died):
            return f"the trial {answer.reason}"
        try:
            said = from_json(answer)
            trial = Trial.from_json(said)
        except NONSENSE:
            return "the trial sent an invalid answer"
        self._cache.put(_KIND, self._key, said)
        return trial


def start_trial(robot: Robot, cache: Cache, *, thorough: bool = False) -> Pending:
    """Start the trial of a robot; it drives while the caller does something else.

    Args:
        robot: What is driven.
        cache: Where results are kept.
        thorough: At half the time step, to see whether that changes the verdict.
    """
    plan = plan_of(robot)
    timestep = TIMESTEP / 2 if thorough else TIMESTEP
    belts = [belt.link for belt in plan.belts]
    servos = (*plan.speeds, *plan.places)
    scene = build_scene(robot, servos=servos, belts=belts, timestep=timestep)
    if scene.unusable:
        return Pending(cache, _outcome=scene.unusable)
    request = {"scene": scene.as_json(), "plan": plan.as_json(), "timestep": timestep}
    text = json.dumps(request).encode()
    key = key_of(text, code_hash("trial"), *map(version_of, _LIBRARIES))
    known = _known(cache.get(_KIND, key))
    if known is not None:
        return Pending(cache, _outcome=known)
    return Pending(cache, key, Child("checker.trial.worker", text, LIMITS))


def _known(said: Any) -> Trial | None:
    try:
        return Trial.from_json(said) if said is not None else None
    except (KeyError, TypeError, ValueError, AttributeError):
        return None
