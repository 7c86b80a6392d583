"""Work on a stage of a check that a worker has taken from a queue.

A stage may start again at any point, after a crash, in another process: a result that is in the
store already is found there, and each further task is entered once.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import msgspec
from msgspec import field
from msgspec.structs import replace

from checker.base.record import Record
from checker.service.jobs.check import check_upload
from checker.service.jobs.children import Children
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import reachable
from checker.service.jobs.durable.receipts import SHOWN_DIGITS
from checker.service.jobs.durable.tasks import End, Task
from checker.service.jobs.outcome import (
    FAILED_INSIDE,
    Cancelled,
    Checked,
    Died,
    Disturbed,
    Refused,
)
from checker.service.jobs.port import JobsUnreachable, Stage
from checker.service.logs import FIELDS
from checker.service.store.store import Store

_T = TypeVar("_T")
_LOG = logging.getLogger(__name__)
_RETRY_SECONDS = 1.0
_LOOK_SECONDS = 1.0
"""Pause between two queries of the database whether a check is still wanted."""
_TRIAL_SECONDS, _TRIAL_SHARE = 3.0, 2.0
"""A trial and the drawing of all that was found take so long, and so many times as long as the
rules did, in whole seconds: of real packages, within a factor of two."""


class Stages(Record):
    """Does stages of checks.

    Attributes:
        checks: The checks in the database.
        store: Uploads and results.
        children: Do the work.
        hand_back: Set when there is no more time to finish running tasks.
    """

    checks: Checks
    store: Store
    children: Children
    hand_back: threading.Event = field(default_factory=threading.Event)

    def run(self, given: dict[str, Any]) -> dict[str, Any]:
        """Do a task, as a workflow of DBOS.

        Args:
            given: The task, as JSON has it.

        Returns:
            The end of its check (`tasks.End`), as JSON has it; empty if a further task follows.
        """
        task, begun = msgspec.convert(given, Task), time.monotonic()
        try:
            end = task.end or task.given_up or self._done(task)
        except Exception:  # noqa: BLE001 - whatever it is
            _LOG.exception("the checker failed", extra=_about(task))
            end = End(Stage.FAILED, FAILED_INSIDE, task.result, task.packages)
        seconds = round(time.monotonic() - begun, 3)
        outcome = end.stage.value if end else "continued"
        _LOG.info("stage ended", extra=_about(task, seconds=seconds, outcome=outcome))
        return msgspec.to_builtins(end) if end else {}

    def _done(self, task: Task) -> End | None:
        is_unwanted = self._question(task)
        if is_unwanted():
            return None
        begun = time.monotonic()
        outcome = check_upload(self.store, self.children, task.order, task.stage, is_unwanted)
        match outcome:
            case Cancelled():
                if self.hand_back.is_set():
                    retry_until_answered(lambda: self.checks.hand_back(task))
            case Disturbed(reason):
                _LOG.warning("to be tried again: %s", reason, extra=_about(task))
                retry_until_answered(lambda: self.checks.retry(task, reason))
            case Checked() if task.stage is Stage.STATIC:
                cost = _TRIAL_SECONDS + _TRIAL_SHARE * (time.monotonic() - begun)
                trial = _trial_after(task, outcome, cost)
                retry_until_answered(lambda: self.checks.enter(trial))
            case Checked():
                return End(Stage.DONE, outcome.words, outcome.key, outcome.packages)
            case Refused(reason):
                return End(Stage.REFUSED, reason)
            case Died(reason):  # after static rules that died a trial would need more of everything
                return End(Stage.FAILED, reason, task.result, task.packages)
        return None

    def _question(self, task: Task) -> Callable[[], bool]:
        """Return the test whether to stop: no time is left, or the check is not wanted here."""
        last_look, is_wanted = -_LOOK_SECONDS, True

        def is_unwanted() -> bool:
            nonlocal last_look, is_wanted
            if time.monotonic() - last_look > _LOOK_SECONDS:
                last_look = time.monotonic()
                try:
                    with reachable():
                        is_wanted = self.checks.is_wanted(task)
                except JobsUnreachable:
                    is_wanted = True
            return self.hand_back.is_set() or not is_wanted

        return is_unwanted


def _trial_after(task: Task, outcome: Checked, cost: float) -> Task:
    """Return the trial of a check whose static rules are done."""
    return replace(
        task,
        stage=Stage.TRIAL,
        number=1,
        reason="",
        result=outcome.key,
        packages=outcome.packages,
        cost=cost,
        secret="",
    )


def retry_until_answered(ask: Callable[[], _T]) -> _T:
    """Query the database until it answers: the result of minutes of work is not thrown away."""
    is_away = False
    while True:
        try:
            with reachable():
                return ask()
        except JobsUnreachable as error:
            if not is_away:
                _LOG.warning("%s; asks again each second", error)
            is_away = True
            time.sleep(_RETRY_SECONDS)


def _about(task: Task, **more: object) -> Mapping[str, Mapping[str, object]]:
    """Return what a line of the log states about a task."""
    key = task.key[:SHOWN_DIGITS]
    return {FIELDS: {"check": key, "stage": task.stage.value, "try": task.number, **more}}
