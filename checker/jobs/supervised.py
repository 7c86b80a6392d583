"""A child process with all that it starts: watched, and ended together."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Callable
from contextlib import suppress
from time import monotonic, sleep

from checker.record import record

_GLANCE, _LOOK = 0.05, 0.2
"""Seconds between looks at the child, and between questions whether it is still wanted."""


@record()
class Ended:
    """How it ended.

    Attributes:
        code: Exit code; of a signal, its negative number.
        overdue: It took too long and was stopped.
        cancelled: It was no longer wanted and was stopped.
    """

    code: int
    overdue: bool = False
    cancelled: bool = False


def supervised(
    process: subprocess.Popen[bytes], seconds: float, cancelled: Callable[[], bool]
) -> Ended:
    """Watch a process that began a session of its own; at the end none of its processes is left.

    Args:
        process: What to watch.
        seconds: By the clock, before it is stopped.
        cancelled: Whether it is no longer wanted; asked a few times a second.
    """
    overdue = unwanted = False
    try:
        overdue, unwanted = _watch(process.pid, seconds, cancelled)
    finally:
        # Before it is waited for: until then nobody else can get the number of its group.
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        code = process.wait()
    return Ended(code, overdue, unwanted)


def _watch(pid: int, seconds: float, cancelled: Callable[[], bool]) -> tuple[bool, bool]:
    """Wait for a process; return whether it is overdue and whether it is unwanted."""
    deadline, look = monotonic() + seconds, 0.0
    while os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
        now = monotonic()
        if now > deadline:
            return True, False
        if now >= look:
            look = now + _LOOK
            if cancelled():
                return False, True
        sleep(_GLANCE)
    return False, False
