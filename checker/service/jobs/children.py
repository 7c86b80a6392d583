"""The processes that check uploads, the next one started before there is anything for it to do.

Python takes a second to load all that a check needs: as long as many a check itself.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from time import monotonic

from msgspec.structs import replace

from checker.base.child_process import Child, Limits
from checker.base.record import Record
from checker.base.sandbox.files import NO_FILES, Content, Files
from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.usage import Usage
from checker.service.jobs.exchange import MOST, NICENESS, StageLimits
from checker.service.store.store import Store

MODULE = f"{__package__}.check_child"
ANSWER_LIMIT = 5_000_000
"""Bytes of the answer, besides the files of the result."""
_LOOK = 0.2
"""Seconds between questions whether a check is still wanted."""
_MEASURE, _REST = 0.5, 20
"""Seconds from one look at what a check uses to the next, and how many times as long as a look."""


class Ended(Record):
    """End of a check.

    Attributes:
        code: Exit code of its process, for a signal its negative number; None if there is none.
        answer: The answer, if there is one; the reason of one that failed.
        files: The files that it made.
        overdue: Whether it took too long and was stopped.
        cancelled: Whether it was no longer wanted and was stopped.
        exceeded: The resource of which its processes together used too much; else empty.
    """

    code: int | None
    answer: bytes = b""
    files: Files = NO_FILES
    overdue: bool = False
    cancelled: bool = False
    exceeded: str = ""


class _Place:
    """A process that checks, its folder and its sandbox: for one check, and then no more."""

    def __init__(self, store: Store, limits: Limits, niceness: int) -> None:
        """Start it."""
        with ExitStack() as held:
            folder = held.enter_context(store.workplace())
            starter = OwnLauncher(folder, niceness=NICENESS + niceness)
            held.enter_context(closing(starter))
            self._starter, self._folder = starter, folder
            self._next_look = 0.0
            self.child = Child(
                MODULE, None, limits, starter=starter, works=True, folder=folder.parent
            )
            held.callback(self.child.stop)
            self._held = held.pop_all()

    def lower_priority(self, by: int) -> None:
        """Give its processes a lower priority than other checks have."""
        self._starter.lower_priority(by)

    @property
    def alive(self) -> bool:
        """True if it can still check."""
        return self._starter.alive and self.child.alive

    def excess(self, most: Usage) -> str:
        """Return what its processes use too much of, checked now and then; else nothing."""
        begin = monotonic()
        if begin < self._next_look:
            return ""
        used = self._starter.usage(self._folder, most)
        took = monotonic() - begin
        self._next_look = monotonic() + max(_MEASURE, _REST * took)
        return used.excess_over(most)

    def close(self) -> None:
        """End all of its processes, and remove its folder."""
        self._held.close()


class Children:
    """Runs checks in processes, each of them once."""

    def __init__(self, store: Store, ahead: bool = True) -> None:
        """Start nothing yet.

        Args:
            store: Contains the folders that they work in.
            ahead: Whether one is to wait for the next check.
        """
        self._store, self._ahead = store, ahead
        self._lock = threading.Lock()
        self._waiting: _Place | None = None

    @contextmanager
    def run_check(
        self,
        request: bytes,
        contents: Iterable[tuple[str, Content]],
        seconds: float,
        cancelled: Callable[[], bool],
        niceness: int = 0,
    ) -> Iterator[Ended]:
        """Check an upload in a process; at the end none of its processes is left.

        Args:
            request: See `checker.service.jobs.check_child`.
            contents: The files that go with it.
            seconds: Seconds of real time before it is stopped.
            cancelled: Whether it is no longer wanted; called a few times a second.
            niceness: The value for `nice` that gives it a lower priority than other checks.

        Yields:
            How it ended; its files can be read meanwhile.

        Raises:
            OSError: The system starts no process, or the disk is full.
        """
        place = self._take(niceness)
        try:
            place.child.give(request, contents)
            yield _watched(place, seconds, cancelled)
        finally:
            place.close()
            # Not before: the next one would take processors from this one.
            self.get_ready()

    def get_ready(self) -> None:
        """Start a process that waits for the next check; where that fails, the check states why."""
        with self._lock, suppress(OSError):
            if self._ahead and not self._has_one():
                self._waiting = self._start()

    def close(self) -> None:
        """End the waiting process, and start no other one; those that check continue."""
        with self._lock:
            self._ahead = False
            if self._waiting is not None:
                self._waiting.close()
                self._waiting = None

    def _take(self, niceness: int) -> _Place:
        with self._lock:
            place, self._waiting = (self._waiting if self._has_one() else None), None
        if place is None:
            return self._start(niceness)
        if niceness:
            place.lower_priority(niceness)
        return place

    def _has_one(self) -> bool:
        """Return whether a process waits; one that has ended meanwhile is removed."""
        if self._waiting is not None and not self._waiting.alive:
            self._waiting.close()
            self._waiting = None
        return self._waiting is not None

    def _start(self, niceness: int = 0) -> _Place:
        most = StageLimits(0.0)
        return _Place(self._store, Limits(_PROCESSOR_SECONDS, most.memory), niceness)


_PROCESSOR_SECONDS = 3600.0
"""More than any stage has: its own limit comes with the request."""


def _watched(place: _Place, seconds: float, cancelled: Callable[[], bool]) -> Ended:
    """Wait for a process, and return how it ended."""
    child, deadline = place.child, monotonic() + seconds
    most = replace(MOST, disk=MOST.disk + 2 * child.bytes_sent)
    unwanted = cancelled()
    while not child.ends(min(_LOOK, max(0.0, deadline - monotonic()))):
        unwanted = unwanted or cancelled()
        if unwanted or monotonic() >= deadline:
            return Ended(None, overdue=not unwanted, cancelled=unwanted)
        if exceeded := place.excess(most):
            return Ended(None, exceeded=exceeded)
    answered = child.answered(ANSWER_LIMIT)
    return Ended(child.code, *answered) if isinstance(answered, tuple) else Ended(child.code)
