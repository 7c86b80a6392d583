"""A process with limits that answers one request after the other, so that it loads but once.

Requests come one behind the other in one file, answers in another; two pipes give the place of
each. No socket is needed, so that a process in the sandbox can have such a process too.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from time import monotonic

from checker.base import child_process
from checker.base.child_process import Child, Limits, overdue
from checker.base.exit_causes import cause_of
from checker.base.parts import WorkerFailed
from checker.base.sandbox import files as handed
from checker.base.sandbox.files import Content
from checker.base.sandbox.task import PLACE
from checker.base.system import FORKS, readable

_ENDS_SECONDS = 5.0
"""Until the exit code of a process that has died is known, at most."""


class _Process(Child):
    """The process of a server."""

    def __init__(self, module: str, limits: Limits) -> None:
        """Start it."""
        self._done, theirs = os.pipe()
        try:
            super().__init__(module, None, limits, done=theirs)
        finally:
            os.close(theirs)
        self._given = 0
        self._places: list[tuple[int, int]] = []

    def ask(self, request: bytes, contents: Iterable[tuple[str, Content]]) -> Asked:
        """Send a request."""
        start = self._request.seek(0, os.SEEK_END)
        handed.write(self._request, request, contents)
        self._started.begin(PLACE.pack(start, self._request.tell()))
        self._given += 1
        return Asked(self, self._given - 1)

    @property
    def bytes_given(self) -> int:
        """Size of all requests so far, which stay on disk until it ends."""
        return 0 if self._stopped else os.fstat(self._request.fileno()).st_size

    def answer_to(self, number: int, deadline: float) -> bytes | WorkerFailed:
        """Wait for the answer to a request; a process that takes too long is stopped."""
        while not self._stopped and len(self._places) <= number:
            if not readable(self._done, deadline - monotonic()):
                self.stop()
                return overdue(self.limits)
            place = os.read(self._done, PLACE.size)
            if len(place) < PLACE.size:
                self.ends(_ENDS_SECONDS)
                return cause_of(self.code, self.limits.seconds, self.limits.memory)
            self._places.append(PLACE.unpack(place))
        if self._stopped:
            return WorkerFailed("was stopped", momentary=True)
        answer = self.answered(child_process.ANSWER_LIMIT, *self._places[number])
        return answer if isinstance(answer, WorkerFailed) else answer[0]

    def stop(self) -> None:
        """End the process, whatever it does; nothing happens if it has been stopped."""
        if not self._stopped:
            super().stop()
            os.close(self._done)


class Asked:
    """A request to a server, and the answer once it is there."""

    def __init__(self, process: _Process, number: int) -> None:
        """Take it over; its time begins now."""
        self._process, self._number = process, number
        self._deadline = monotonic() + process.limits.clock_seconds
        self._wanted = True

    def answer(self) -> bytes | WorkerFailed:
        """Wait for the answer."""
        if not self._wanted:
            return WorkerFailed("was given up")
        return self._process.answer_to(self._number, self._deadline)

    def stop(self) -> None:
        """Cancel this request; the process continues with others."""
        self._wanted = False


class Server:
    """Starts its process at the first request; one that ended is started again."""

    def __init__(self, module: str, limits: Limits) -> None:
        """Start nothing yet.

        Args:
            module: The module, as in `Child`.
            limits: What the process may use for all requests; by the clock, for each.
        """
        self._module, self._limits = module, limits
        self._process: _Process | None = None

    @property
    def alive(self) -> bool:
        """True if its process waits for a request or handles one."""
        return self._process is not None and self._process.alive

    @property
    def bytes_given(self) -> int:
        """Size of all requests to its process, which stay on disk until it is stopped."""
        return self._process.bytes_given if self._process is not None else 0

    def start(self) -> Server:
        """Start the process, if there is none."""
        if FORKS:
            self._running()
        return self

    def give(self, request: bytes, contents: Iterable[tuple[str, Content]] = ()) -> Asked | Child:
        """Send a request; it is answered after those before it.

        Where nothing forks, it gets a process of its own.
        """
        if not FORKS:
            return Child(self._module, request, self._limits, contents)
        return self._running().ask(request, contents)

    def stop(self) -> None:
        """End the process, whatever it does."""
        if self._process is not None:
            self._process.stop()

    def _running(self) -> _Process:
        if self._process is None or not self._process.alive:
            self.stop()
            self._process = _Process(self._module, self._limits)
        return self._process
