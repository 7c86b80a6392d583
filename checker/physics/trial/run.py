"""The trials of a package's robots: begun early, collected when a rule first asks for them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from checker.base.cache import Cache, code_hash, key_of
from checker.base.child_process import NONSENSE, Child, Died, Limits, from_json
from checker.base.errors import NotAtHand
from checker.base.progress import Stages
from checker.base.record import Record
from checker.base.resources import version_of
from checker.model.robot import Robot
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.physics.trial.trial import Trial

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
            return "the trial was answered with nonsense"
        self._cache.put(_KIND, self._key, said)
        return trial


def start_trial(robot: Robot, cache: Cache, *, thorough: bool = False) -> Pending:
    """Start the trial of a robot; it drives while the caller does something else.

    Args:
        robot: What is driven.
        cache: Where results are kept.
        thorough: At half the time step, to see whether that changes the verdict.
    """
    # Only a check that drives loads what builds scenes.
    from checker.physics.trial.drivers.plans import plan_of
    from checker.physics.trial.mjcf.scene import build_scene

    plan = plan_of(robot)
    timestep = TIMESTEP / 2 if thorough else TIMESTEP
    belts = [belt.link for belt in plan.belts]
    servos = (*plan.speeds, *plan.places)
    scene = build_scene(robot, servos=servos, belts=belts, timestep=timestep)
    if scene.unusable:
        return Pending(cache, _outcome=scene.unusable)
    request = {"scene": scene.as_json(), "plan": plan.as_json(), "timestep": timestep}
    text = json.dumps(request).encode()
    key = key_of(text, code_hash("physics/trial"), *map(version_of, _LIBRARIES))
    known = _known(cache.get(_KIND, key))
    if known is not None:
        return Pending(cache, _outcome=known)
    return Pending(cache, key, Child("checker.physics.trial.worker", text, LIMITS))


def _known(said: Any) -> Trial | None:
    try:
        return Trial.from_json(said) if said is not None else None
    except (KeyError, TypeError, ValueError, AttributeError):
        return None


ROBOTS_LIMIT = 8
"""Of one file; a world with more of them is no submission, and each takes about a second."""


class Driving(Record, eq=False, dict=True):
    """The trials of some robots."""

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages

    def begin(self, *, twice: bool) -> None:
        """Begin with the first robot; its trial goes on while the caller does something else.

        Args:
            twice: Also at half the time step.
        """
        # What goes wrong is said when a rule asks for the trial.
        with suppress(Exception):
            if self.obstacle is None:
                _ = self._first, twice and self._first_again

    def stop(self) -> None:
        """End the trials that nobody has waited for."""
        for name in ("_first", "_first_again"):
            pending = self.__dict__.get(name)
            if pending is not None:
                pending.stop()

    @cached_property
    def once(self) -> tuple[RobotTrial, ...] | NotAtHand:
        """The robots and what their trials measured."""
        trials = self._collected(thorough=False)
        if isinstance(trials, NotAtHand):
            return trials
        return tuple(map(RobotTrial, self.robots, trials))

    @cached_property
    def twice(self) -> tuple[RepeatedTrial, ...] | NotAtHand:
        """The same with what was measured at half the time step."""
        trials, again = self._collected(thorough=False), self._collected(thorough=True)
        if isinstance(trials, NotAtHand):
            return trials
        if isinstance(again, NotAtHand):
            return again
        return tuple(map(RepeatedTrial, self.robots, trials, again))

    @cached_property
    def obstacle(self) -> NotAtHand | None:
        """Why these robots cannot be driven at all."""
        if len(self.robots) > ROBOTS_LIMIT:
            reason = f"the file holds {len(self.robots)} robots, at most {ROBOTS_LIMIT} are driven"
            return NotAtHand(reason)
        reasons = (_obstacle(robot) for robot in self.robots)
        return next((reason for reason in reasons if reason is not None), None)

    @cached_property
    def _first(self) -> Pending:
        return self._started(self.robots[0], thorough=False)

    @cached_property
    def _first_again(self) -> Pending:
        return self._started(self.robots[0], thorough=True)

    def _started(self, robot: Robot, *, thorough: bool) -> Pending:

        twice = ", again at half the time step" if thorough else ""
        with self.stages.stage("trial", f"driving the robot on its course in MuJoCo{twice}"):
            return start_trial(robot, self.cache, thorough=thorough)

    def _collected(self, *, thorough: bool) -> Sequence[Trial] | NotAtHand:
        if self.obstacle is not None:
            return self.obstacle
        trials: list[Trial] = []
        for number, robot in enumerate(self.robots):
            if number == 0:
                pending = self._first_again if thorough else self._first
            else:
                pending = self._started(robot, thorough=thorough)
            with self.stages.stage("trial"):
                trial = pending.result()
            if not isinstance(trial, Trial):
                return NotAtHand(trial)
            trials.append(trial)
        return trials


def _obstacle(robot: Robot) -> NotAtHand | None:
    """Say why a model is nothing to drive at all."""
    if not robot.links:
        return NotAtHand("the model has no links, so there is nothing to drive", applicable=False)
    if robot.is_static:
        return NotAtHand("the model is static, so there is nothing to drive", applicable=False)
    return None
