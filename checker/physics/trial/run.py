"""The trials of a package's robots: begun early, collected when a rule first asks for them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.output import Stages
from checker.base.parts import NotAvailable, WorkerFailed
from checker.base.record import Record
from checker.model.robot import Robot
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.physics.trial.trial import Trial

TIMESTEP = 0.002
"""Seconds; contacts and servos are tuned to it."""
LIMITS = Limits(seconds=20.0, memory=1_000_000_000)

_LIBRARIES = ("mujoco", "numpy", "scipy")


def start_trial(robot: Robot, cache: Cache, *, thorough: bool = False) -> Background[Trial] | str:
    """Start the trial of a robot; else return why it has none, as the end of a sentence.

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
        return scene.unusable
    item = {"scene": scene.as_json(), "plan": plan.as_json(), "timestep": timestep}
    key = work_key([json.dumps(item)], ["physics/trial"], _LIBRARIES)
    module = "checker.physics.trial.worker"
    trial = Background(Work("trial", module, LIMITS, {key: item}, Trial.from_json), cache)
    trial.begin()
    return trial


ROBOTS_LIMIT = 8
"""Of one file; a world with more of them is no submission, and each takes about a second."""


class RobotTrials(Record, eq=False, dict=True):
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
            if isinstance(pending, Background):
                pending.stop()

    @cached_property
    def once(self) -> tuple[RobotTrial, ...] | NotAvailable:
        """The robots and what their trials measured."""
        trials = self._collected(thorough=False)
        if isinstance(trials, NotAvailable):
            return trials
        return tuple(map(RobotTrial, self.robots, trials))

    @cached_property
    def twice(self) -> tuple[RepeatedTrial, ...] | NotAvailable:
        """The same with what was measured at half the time step."""
        trials, again = self._collected(thorough=False), self._collected(thorough=True)
        if isinstance(trials, NotAvailable):
            return trials
        if isinstance(again, NotAvailable):
            return again
        return tuple(map(RepeatedTrial, self.robots, trials, again))

    @cached_property
    def obstacle(self) -> NotAvailable | None:
        """Why these robots cannot be driven at all."""
        if len(self.robots) > ROBOTS_LIMIT:
            reason = (
                f"the file contains {len(self.robots)} robots, but at most {ROBOTS_LIMIT} are "
                "driven"
            )
            return NotAvailable(reason)
        reasons = (_obstacle(robot) for robot in self.robots)
        return next((reason for reason in reasons if reason is not None), None)

    @cached_property
    def _first(self) -> Background[Trial] | str:
        return self._started(self.robots[0], thorough=False)

    @cached_property
    def _first_again(self) -> Background[Trial] | str:
        return self._started(self.robots[0], thorough=True)

    def _started(self, robot: Robot, *, thorough: bool) -> Background[Trial] | str:
        twice = ", again at half the time step" if thorough else ""
        with self.stages.stage("trial", f"driving the robot on its course in MuJoCo{twice}"):
            return start_trial(robot, self.cache, thorough=thorough)

    def _collected(self, *, thorough: bool) -> Sequence[Trial] | NotAvailable:
        if self.obstacle is not None:
            return self.obstacle
        trials: list[Trial] = []
        for number, robot in enumerate(self.robots):
            if number == 0:
                begun = self._first_again if thorough else self._first
            else:
                begun = self._started(robot, thorough=thorough)
            if isinstance(begun, str):
                return NotAvailable(begun)
            with self.stages.stage("trial"):
                trial = begun.result()
            if isinstance(trial, WorkerFailed):
                return NotAvailable(f"the trial {trial.reason}")
            trials.append(trial)
        return trials


def _obstacle(robot: Robot) -> NotAvailable | None:
    """Say why a model is nothing to drive at all."""
    if not robot.links:
        return NotAvailable(
            "the model has no links, so there is nothing to drive", applicable=False
        )
    if robot.is_static:
        return NotAvailable("the model is static, so there is nothing to drive", applicable=False)
    return None
