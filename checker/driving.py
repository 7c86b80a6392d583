"""The trials of a package's robots: begun early, collected when a rule first asks for them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING

from checker.cache import Cache
from checker.model.robot import Robot
from checker.parts import NotAtHand
from checker.record import record
from checker.saying import Stages
from checker.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.trial.trial import Trial

if TYPE_CHECKING:
    from checker.trial.running import Pending

ROBOTS_LIMIT = 8
"""Of one file; a world with more of them is no submission, and each takes about a second."""


@record(eq=False)
class Driving:
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
            reason = (
                f"the file contains {len(self.robots)} robots, but at most {ROBOTS_LIMIT} are "
                "driven"
            )
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
        from checker.trial.running import start_trial

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
