"""Takes checks from the queues as long as there is room for them, each in a thread of its own."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from time import monotonic

from checker.service.jobs.durable.changes import Changes
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import reachable
from checker.service.jobs.durable.steps import Held, Taker
from checker.service.jobs.durable.tables import STAGES
from checker.service.jobs.port import JobsUnreachable, Stage

_LOG = logging.getLogger(__name__)
_LOOK_SECONDS = 1.0
"""Between two looks into the queues when nothing changes: a check may wait for its next try."""
_APART_SECONDS = 0.05
"""Between two looks of which the first finds nothing: each upload is a change, and many come at
once."""


class Dispatcher:
    """Takes checks and has them done.

    Each stage has its places. Beyond these it has one that is for senders of whom nothing is in
    hand in this stage, by any worker: however many long checks somebody sends, the first findings
    of others do not wait for them.
    """

    def __init__(
        self,
        checks: Checks,
        taker: Taker,
        places: Mapping[Stage, int],
        run: Callable[[Held], None],
    ) -> None:
        """Take nothing yet.

        Args:
            checks: The table of checks.
            taker: This process.
            places: For checks in hand, by their stage.
            run: Does a stage of a check; it raises nothing.
        """
        self._checks, self._taker, self._places, self._run = checks, taker, places, run
        self._running: dict[Stage, set[threading.Thread]] = {stage: set() for stage in STAGES}
        self._ended = threading.Condition()
        self._is_away = False

    def take_until(self, stop: threading.Event, changes: Changes) -> None:
        """Take checks until `stop` is set.

        Args:
            stop: Looked at each second.
            changes: Tells of what may have come into the queues.
        """
        while not stop.is_set():
            looked = monotonic()
            if not self._take_one():
                changes.wait(_LOOK_SECONDS)
                stop.wait(max(0.0, looked + _APART_SECONDS - monotonic()))

    def wait(self, seconds: float) -> bool:
        """Wait until nothing is in hand any more; False if something is after so many seconds."""
        with self._ended:
            return self._ended.wait_for(lambda: not any(self._running.values()), seconds)

    def _take_one(self) -> bool:
        """Take a check, if there is one and room for it."""
        try:
            with reachable():
                held = next(filter(None, map(self._next, STAGES)), None)
        except JobsUnreachable as error:
            if not self._is_away:
                _LOG.warning("%s; looks again each second", error)
            self._is_away = True
            return False
        self._is_away = False
        if held is not None:
            self._begin(held)
        return held is not None

    def _next(self, stage: Stage) -> Held | None:
        with self._ended:
            free = self._places[stage] - len(self._running[stage])
        if free < 0:
            return None
        return self._checks.take(self._taker, stage, others=free == 0)

    def _begin(self, held: Held) -> None:
        thread = threading.Thread(target=self._do, args=(held,), daemon=True)
        with self._ended:
            self._running[held.stage].add(thread)
        thread.start()

    def _do(self, held: Held) -> None:
        try:
            self._run(held)
        finally:
            with self._ended:
                self._running[held.stage].discard(threading.current_thread())
                self._ended.notify_all()
