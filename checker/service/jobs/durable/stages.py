"""What a worker does with a stage of a check that it has taken from a queue.

A stage may begin again at any point, after a crash, in another process: a result that is in the
store already is found there, and each step is written down once.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import TypeVar

import sqlalchemy as sa
from msgspec import field

from checker.base.record import Record
from checker.service.jobs.check import check_upload
from checker.service.jobs.children import Children
from checker.service.jobs.durable.checks import Checks, forget
from checker.service.jobs.durable.client import finished
from checker.service.jobs.durable.database import now, reachable
from checker.service.jobs.durable.steps import Held, Step, Taker
from checker.service.jobs.durable.tables import CHECKS
from checker.service.jobs.outcome import (
    FAILED_INSIDE,
    Cancelled,
    Checked,
    Died,
    Disturbed,
    Refused,
)
from checker.service.jobs.port import JobsUnreachable, Stage
from checker.service.store.store import Store

# What is deleted, and when: checks after their time, then what nothing refers to any more.


_AT_ONCE = 200


class Retention(Record):
    """Deletes what has had its time; any number of workers may do so at once.

    Attributes:
        engine: Of the database.
        store: Uploads and results.
        grace_seconds: That a file stays which no check refers to: one may be about to.
    """

    engine: sa.Engine
    store: Store
    grace_seconds: float

    def delete(self) -> None:
        """Delete what has had its time."""
        while ids := self._expired():
            with self.engine.begin() as connection:
                forget(connection, ids)
        self.store.expire(time.time() - self.grace_seconds, self._referred())
        self.store.sweep()

    def _expired(self) -> list[str]:
        over = sa.select(CHECKS.c.id).where(CHECKS.c.expires <= now(self.engine)).limit(_AT_ONCE)
        with self.engine.connect() as connection:
            return list(connection.execute(over).scalars())

    def _referred(self) -> set[str]:
        """Return the hashes and keys that checks refer to."""
        with self.engine.connect() as connection:
            pairs = connection.execute(sa.select(CHECKS.c.upload, CHECKS.c.result).distinct())
            return {part for pair in pairs for part in pair if part}


_T = TypeVar("_T")
_LOG = logging.getLogger(__name__)
_RETRY_SECONDS = 1.0
_ALONE_LOOK_SECONDS = 0.5
_READ = "the static rules are finished; the trial is waiting in the queue"
_TRIAL_SECONDS, _TRIAL_SHARE = 3.0, 2.0
"""A trial and the drawing of all that was found take so long, and so many times as long as the
rules did, in whole seconds: of real packages, within a factor of two."""


class Stages(Record):
    """Does stages of checks.

    Attributes:
        checks: The table of checks.
        store: Uploads and results.
        taker: This process.
        children: Do the work.
        hand_back: Set when there is no more time to finish what is in hand.
    """

    checks: Checks
    store: Store
    taker: Taker
    children: Children
    hand_back: threading.Event = field(default_factory=threading.Event)

    def run(self, held: Held) -> None:
        """Do a stage of a check, and write down what came of it."""
        try:
            self._do(held)
        except Exception:  # noqa: BLE001 - whatever it is
            # Left alone, the check would stay in hand for ever.
            _LOG.exception("a check fails in its stage %s", held.stage)
            patiently(lambda: self.checks.settle(held, Step("end", Stage.FAILED, FAILED_INSIDE)))

    def _do(self, held: Held) -> None:
        self._wait_until_alone(held)
        begun = time.monotonic()
        outcome = check_upload(
            self.store, self.children, held.order, held.stage, lambda: self._unwanted(held)
        )
        match outcome:
            case Cancelled():
                if self.hand_back.is_set():
                    patiently(lambda: self.checks.release(held))
            case Disturbed(reason):
                _LOG.warning("a check comes to nothing in its stage %s: %s", held.stage, reason)
                patiently(lambda: self.checks.put_off(held, reason))
            case _:
                step = _conclusion(outcome, held.stage)
                cost = _TRIAL_SECONDS + round(_TRIAL_SHARE * (time.monotonic() - begun))
                patiently(lambda: self.checks.settle(held, step, cost))

    def _wait_until_alone(self, held: Held) -> None:
        """Let what else is in hand on this machine end before a last try."""
        while held.is_last and not self._unwanted(held):
            if patiently(lambda: self.checks.is_alone(held, self.taker)):
                return
            self.hand_back.wait(_ALONE_LOOK_SECONDS)

    def _unwanted(self, held: Held) -> bool:
        """Whether to stop: no time is left, somebody cancelled it, or another worker has it."""
        try:
            with reachable():
                return self.hand_back.is_set() or not self.checks.holds(held)
        except JobsUnreachable:
            return False


def _conclusion(outcome: Checked | Refused | Died, stage: Stage) -> Step:
    """Return what a check comes to by the outcome of a stage.

    After a static stage that died there is no trial: it would need more of everything.
    """
    match outcome:
        case Checked() if stage is Stage.STATIC:
            data = {"result": outcome.key}
            return Step("read", Stage.TRIAL, _READ, outcome.key, outcome.packages, data)
        case Checked():
            return finished(outcome)
        case Refused(reason):
            return Step("end", Stage.REFUSED, reason)
        case Died(reason):
            return Step("end", Stage.FAILED, reason)


def patiently(ask: Callable[[], _T]) -> _T:
    """Ask the database until it answers: what came of minutes of work is not thrown away."""
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
