"""Keeps processes running: starts them, restarts those that ended, and stops them in order.

A process that ends with exit code 0 was told to end, and is not restarted.
"""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from time import monotonic

from checker.base.output import Say
from checker.base.record import Record

_LOOK_SECONDS = 0.2
_SETTLED_SECONDS = 60.0
"""A process that lives so long is well: the next death is a new misfortune."""
_DEATHS_COUNTED = 30


class Pace(Record):
    """Time limits of the supervisor.

    Attributes:
        first_wait: Seconds before a dead process is started again; they double each time.
        longest_wait: Seconds.
        grace: Seconds that processes have to end after a request to.
    """

    first_wait: float = 1.0
    longest_wait: float = 60.0
    grace: float = 45.0


@dataclass
class Process:
    """A process to run.

    Attributes:
        name: The name for messages.
        command: Program and arguments.
        environment: Its variables.
        descriptors: Open files that it takes over.
    """

    name: str
    command: Sequence[str]
    environment: Mapping[str, str]
    descriptors: Sequence[int] = ()
    _running: subprocess.Popen[bytes] | None = None
    _started: float = 0.0
    _deaths: int = 0
    _next_start: float = 0.0

    def start(self) -> None:
        """Start it, apart from the terminal's signals: its parent passes them on."""
        self._started = monotonic()
        self._running = subprocess.Popen(  # noqa: S603 - our own interpreter and module
            list(self.command),
            env=dict(self.environment),
            stdin=subprocess.DEVNULL,
            pass_fds=tuple(self.descriptors),
            process_group=0,
        )

    @property
    def is_running(self) -> bool:
        """True if it runs now."""
        return self._running is not None and self._running.poll() is None

    @property
    def exit_code(self) -> int:
        """The exit code of its last run; 0 while it runs."""
        return (self._running.poll() or 0) if self._running is not None else 0

    def mend(self, pace: Pace, say: Say) -> None:
        """Start it again if it has died and has waited for its turn."""
        if self.is_running:
            return
        now = monotonic()
        if self._running is not None:
            code, self._running = self._running.returncode, None
            if code == 0:  # as a worker that is drained does
                self._next_start = float("inf")
                say(f"{self.name} has ended as it was told, and is not restarted")
            else:
                say(f"{self.name} {_how(code)}; {self._put_off(now, pace)}")
        elif now >= self._next_start:
            self.start()

    def signal(self, number: int) -> None:
        """Send a signal to it and to those that it started and that are still its group."""
        if self._running is not None and self._running.poll() is None:
            with suppress(ProcessLookupError):
                os.killpg(self._running.pid, number)

    def wait(self, seconds: float) -> bool:
        """Wait for its end; False if it has not come by then."""
        if self._running is None:
            return True
        try:
            self._running.wait(max(seconds, 0.0))
        except subprocess.TimeoutExpired:
            return False
        return True

    def _put_off(self, now: float, pace: Pace) -> str:
        """Put off the next start, longer with each death in a row, and return words about it."""
        if now - self._started > _SETTLED_SECONDS:
            self._deaths = 0
        wait = min(pace.first_wait * 2.0**self._deaths, pace.longest_wait)
        self._deaths = min(self._deaths + 1, _DEATHS_COUNTED)
        self._next_start = now + wait
        return f"it restarts in {wait:g} s"


def _how(code: int) -> str:
    if code < 0:
        with suppress(ValueError):
            return f"was ended by {signal.Signals(-code).name}"
    return f"ended with exit code {code}"


def keep_running(processes: Sequence[Process], stop: threading.Event, pace: Pace, say: Say) -> None:
    """Keep processes running until `stop` is set."""
    while not stop.wait(_LOOK_SECONDS):
        for process in processes:
            process.mend(pace, say)


def stop_all(processes: Sequence[Process], at_once: threading.Event, pace: Pace) -> bool:
    """End processes: they may finish their work, unless they must end at once.

    Returns:
        Whether all have ended by themselves.
    """
    for process in processes:
        process.signal(signal.SIGTERM)
    ends = monotonic() + pace.grace
    while any(process.is_running for process in processes):
        if at_once.wait(_LOOK_SECONDS / 4) or monotonic() > ends:
            break
    willing = not any(process.is_running for process in processes)
    for process in processes:
        process.signal(signal.SIGKILL)
        process.wait(10.0)
    return willing
