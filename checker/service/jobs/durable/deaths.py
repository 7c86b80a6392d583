"""Returns tasks of workers that ended to the queue: DBOS waits for a worker of the same name."""

from __future__ import annotations

import logging
import threading
from time import monotonic

from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.workers import Workers
from checker.service.store.locks import dead_processes, forget
from checker.service.store.store import Store

_LOG = logging.getLogger(__name__)
_KNOWN_SILENCES = 60
"""A dead worker stays known for so many times the silence, for display."""


class Deaths:
    """Reports that this worker runs, and retries the tasks of workers that ended.

    The lock of a file shows at once that a worker on this machine has ended; silence shows that
    those on others, or hanging ones, have.
    """

    def __init__(
        self, checks: Checks, workers: Workers, store: Store, name: str, silence: float
    ) -> None:
        """Begin to count the time without a gap in this worker's own signs of life.

        Args:
            checks: The checks in the database.
            workers: The workers with a recent sign of life.
            store: The store, with the folder of workers on this machine.
            name: The name of this worker.
            silence: Seconds after which a worker counts as dead.
        """
        self._checks, self._workers, self._folder = checks, workers, store.workers
        self._name, self._silence = name, silence
        self._last = self._since = monotonic()
        self.drained = threading.Event()

    def look(self) -> None:
        """Show a sign of life, and put the tasks of workers that ended back into the queue.

        `drained` is set once an operator has drained this worker.

        When the database was away, or this machine slept, all workers have been silent: the first
        one that is back must not regard the others as dead.
        """
        if self._workers.record_heartbeat(self._name):
            self.drained.set()
        now = monotonic()
        if now - self._last > self._silence / 2.0:
            self._since = now
        self._last = now
        living = self._workers.live_workers(self._silence) | {self._name}
        steady = now - self._since >= self._silence
        dead = dead_processes(self._folder)
        for name in self._checks.recover(
            lambda name: name in dead or (steady and name not in living)
        ):
            _LOG.warning("%s died; what it had in hand waits again", name)
        for name in dead:
            forget(self._folder, name)
        self._workers.strike_silent(_KNOWN_SILENCES * self._silence)
