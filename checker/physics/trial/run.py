"""The trials of a package's robots: started early, collected when a rule first requests them."""

from __future__ import annotations

import json
from contextlib import suppress
from functools import cached_property

from msgspec import to_builtins
from msgspec.structs import replace

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.output import Stages
from checker.base.parts import NotAvailable, WorkerFailed
from checker.base.record import Record
from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.physics.trial.trial import Trial

TIMESTEP = 0.002
"""Seconds; contacts and servos are tuned to it."""
LIMITS = Limits(seconds=20.0, memory=1_000_000_000)

LIBRARIES = ("mujoco", "numpy", "scipy")


def start_trial(robot: Robot, cache: Cache, *, thorough: bool = False) -> Background[Trial] | str:
    """Start the trial of a robot; else return why it has none, as the end of a sentence.

    Args:
        robot: What is driven.
        cache: The cache of results.
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
    item = {"scene": to_builtins(scene), "plan": to_builtins(plan), "timestep": timestep}
    key = work_key([json.dumps(item)], ["physics/trial"], LIBRARIES)
    module = f"{__package__}.worker"
    trial = Background(Work("trial", module, LIMITS, {key: item}, Trial.from_json), cache)
    trial.begin()
    return trial


ROBOTS_LIMIT = 8
"""Greatest number for one file or package; each takes about a second."""


class RobotTrials(Record, eq=False, dict=True):
    """The trials of some robots."""

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages

    def begin(self, *, twice: bool) -> None:
        """Start with the first robot; its trial runs while the caller does something else.

        Args:
            twice: Also at half the time step.
        """
        # Errors are reported when a rule requests the trial.
        with suppress(Exception):
            if _obstacle(self.robots[0]) is None and 0 not in self._left_out:
                _ = self._first, twice and self._first_again

    def stop(self) -> None:
        """Stop the trials that still run."""
        for name in ("_first", "_first_again"):
            pending = self.__dict__.get(name)
            if isinstance(pending, Background):
                pending.stop()

    @cached_property
    def once(self) -> tuple[RobotTrial, ...] | NotAvailable:
        """The robots that can be driven, and what their trials measured."""
        driven = [
            RobotTrial(robot, trial)
            for robot, trial in zip(self.robots, self._collected, strict=True)
            if isinstance(trial, Trial)
        ]
        missing = [
            trial if number in self._left_out else self._reason(self.robots[number], trial)
            for number, trial in enumerate(self._collected)
            if isinstance(trial, NotAvailable)
        ]
        if not driven:
            return missing[0]
        first, *others = driven
        reasons = (each.reason for each in missing if each.applicable)
        left_out = self._too_many.reason if self._left_out else next(reasons, "")
        return (replace(first, others=left_out), *others)

    @cached_property
    def twice(self) -> tuple[RepeatedTrial, ...] | NotAvailable:
        """The same with what was measured at half the time step."""
        if isinstance(self.once, NotAvailable):
            return self.once
        repeated = []
        for driven in self.once:
            again = self._trial(driven.robot, thorough=True)
            if isinstance(again, NotAvailable):
                return self._reason(driven.robot, again)
            repeated.append(RepeatedTrial(driven.robot, driven.trial, again=again))
        return tuple(repeated)

    @property
    def undriven(self) -> dict[int, str]:
        """Reasons why robots have no trial, by their number; empty before the first request."""
        collected: tuple[Trial | NotAvailable, ...] = self.__dict__.get("_collected", ())
        return {
            number: trial.reason
            for number, trial in enumerate(collected)
            if isinstance(trial, NotAvailable)
        }

    @cached_property
    def _left_out(self) -> frozenset[int]:
        """The numbers of robots that are too many: without drive, those with the fewest joints."""
        driven_first = sorted(
            range(len(self.robots)),
            key=lambda number: (
                self.robots[number].locomotion.kind is DriveKind.NONE,
                -len(self.robots[number].joints),
            ),
        )
        return frozenset(driven_first[ROBOTS_LIMIT:])

    @property
    def _too_many(self) -> NotAvailable:
        return NotAvailable(f"only {ROBOTS_LIMIT} of {len(self.robots)} robots are driven")

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

    @cached_property
    def _collected(self) -> tuple[Trial | NotAvailable, ...]:
        """The trial of each robot, or why it has none."""
        return tuple(
            self._too_many if number in self._left_out else self._trial(robot, thorough=False)
            for number, robot in enumerate(self.robots)
        )

    def _trial(self, robot: Robot, *, thorough: bool) -> Trial | NotAvailable:
        obstacle = _obstacle(robot)
        if obstacle is not None:
            return obstacle
        if robot is self.robots[0]:
            begun = self._first_again if thorough else self._first
        else:
            begun = self._started(robot, thorough=thorough)
        if isinstance(begun, str):
            return NotAvailable(begun)
        with self.stages.stage("trial"):
            trial = begun.result()
        if isinstance(trial, WorkerFailed):
            return NotAvailable(f"the trial {trial.reason}")
        return trial

    def _reason(self, robot: Robot, missing: NotAvailable) -> NotAvailable:
        """Return a reason; of several robots, with the name of the one that it is about."""
        if len(self.robots) == 1 or not missing.applicable:
            return missing
        return NotAvailable(f"{robot.name.value!r} is not driven: {missing.reason}")


def _obstacle(robot: Robot) -> NotAvailable | None:
    """Return the reason why a model is nothing to drive at all."""
    if not robot.links:
        return NotAvailable(
            "the model has no links, so there is nothing to drive", applicable=False
        )
    if robot.is_static:
        return NotAvailable("the model is static, so there is nothing to drive", applicable=False)
    if robot.is_fixture:
        reason = "fixed joints connect all links to the world, so there is nothing to drive"
        return NotAvailable(reason, applicable=False)
    if not robot.gravity:
        reason = "the robot starts in a world without gravity, in which it does not stand"
        return NotAvailable(reason, applicable=False)
    if robot.shown_only and not any(link.collisions for link in robot.links):
        reason = f"the robot has no collisions: {robot.shown_only}"
        return NotAvailable(reason, applicable=False)
    return None
