"""What a worker does with a stage of a check that the queue gives it.

A workflow is one stage. It may begin again at any point, after a crash, in another process: a
result that is in the store already is found there, and the ledger takes each step once.
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
from checker.service.jobs.checking import check_upload
from checker.service.jobs.children import Children
from checker.service.jobs.durable.client import finished
from checker.service.jobs.durable.database import reachable
from checker.service.jobs.durable.ledger import Ledger, Step, Turn
from checker.service.jobs.durable.queues import Queues
from checker.service.jobs.durable.together import Change
from checker.service.jobs.outcome import FAILED_INSIDE, Cancelled, Checked, Died, Refused
from checker.service.jobs.port import JobsUnreachable, Stage
from checker.service.store.store import Store

_T = TypeVar("_T")
_LOG = logging.getLogger(__name__)
_RETRY_SECONDS = 1.0
_BEGINS = {
    Stage.STATIC: Step("static", Stage.STATIC, "the static rules look at the files"),
    Stage.TRIAL: Step("trial", Stage.TRIAL, "the robot is tried on the course"),
}
_READ = "the static rules have looked; the trial waits for its turn"


class Stages(Record):
    """Does stages of checks.

    Attributes:
        ledger: The book of checks.
        queues: Of the same database.
        store: Uploads and results.
        worker: Name of this process.
        children: Do the work.
        hand_back: Set when there is no more time to finish what is in hand.
    """

    ledger: Ledger
    queues: Queues
    store: Store
    worker: str
    children: Children
    hand_back: threading.Event = field(default_factory=threading.Event)

    def run(self, id: str, stage: Stage) -> None:
        """Do a stage of a check, and write down what came of it."""
        turn = _patiently(lambda: self.ledger.take(id, self.worker, _BEGINS[stage]))
        if turn is None:
            return
        try:
            self._do(turn, stage)
        except Exception:  # noqa: BLE001 - whatever it is
            # Left alone, the check would stay in hand for ever.
            _LOG.exception("a check fails in its stage %s", stage)
            _patiently(lambda: self.ledger.settle(turn, Step("end", Stage.FAILED, FAILED_INSIDE)))

    def _do(self, turn: Turn, stage: Stage) -> None:
        outcome = check_upload(
            self.store, self.children, turn.order, stage, lambda: self._unwanted(turn)
        )
        if isinstance(outcome, Cancelled):
            if self.hand_back.is_set() and _patiently(lambda: self.ledger.release(turn)):
                _patiently(lambda: self.queues.put_back(turn.id, stage))
            return
        step = _conclusion(outcome, stage)
        _patiently(lambda: self.ledger.settle(turn, step, self._next(turn, step)))

    def _unwanted(self, turn: Turn) -> bool:
        """Whether to stop: no time is left, somebody cancelled it, or another worker has it."""
        try:
            with reachable():
                return self.hand_back.is_set() or not self.ledger.wanted(turn)
        except JobsUnreachable:
            return False

    def _next(self, turn: Turn, step: Step) -> Change:
        """Return what follows a step, in the same transaction: the trial, or nothing."""

        def then(connection: sa.Connection) -> None:
            if step.stage is Stage.TRIAL:
                self.queues.put(connection, turn.id, Stage.TRIAL)

        return then


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


def _patiently(ask: Callable[[], _T]) -> _T:
    """Ask the database until it answers: what came of minutes of work is not thrown away."""
    while True:
        try:
            with reachable():
                return ask()
        except JobsUnreachable as error:
            _LOG.warning("%s; asking again", error)
            time.sleep(_RETRY_SECONDS)
