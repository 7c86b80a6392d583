"""Reasons why a child process ended without an answer, by its exit code."""

from __future__ import annotations

import signal

from checker.base.parts import WorkerFailed
from checker.base.sandbox.task import DISTURBED, OUT_OF_MEMORY
from checker.base.sandbox.windows_job import OUT_OF_TIME

_KILLED, _TOO_LONG = -9, -24
"""SIGKILL and SIGXCPU, as exit codes; Windows has neither signal."""
_LAST_EXIT_CODE = 0xFFFF
"""Statuses of Windows above it (NTSTATUS) are those of a crash."""
_MOMENTARY = {
    None: "could not be started",
    DISTURBED: "failed because the disk or the system did",
    # Not by limits of ours: of processor time, SIGXCPU comes first; of memory, Python says so.
    _KILLED: "was killed from outside",
}


def timeout_failure(seconds: float) -> WorkerFailed:
    """Return what is stated about a process that needs more processor time than it has."""
    return WorkerFailed(f"needs more than {seconds:g} s of processor time")


def cause_of(code: int | None, seconds: float, memory: float) -> WorkerFailed:
    """Return what is stated about a process that ended with an exit code other than 0.

    Args:
        code: The exit code, for a signal its negative number; None if there is none.
        seconds: Seconds of processor time that it had.
        memory: Bytes of address space that it had.
    """
    if code in _MOMENTARY:
        return WorkerFailed(_MOMENTARY[code], momentary=True)
    if code == OUT_OF_MEMORY:
        return WorkerFailed(f"needs more than {memory / 1e6:.0f} MB of memory")
    if code in (_TOO_LONG, OUT_OF_TIME):
        return timeout_failure(seconds)
    if code is not None and code < 0:
        return WorkerFailed(f"crashed (signal {signal.Signals(-code).name})")
    if code is not None and code > _LAST_EXIT_CODE:
        return WorkerFailed(f"crashed (status {code:#x})")
    return WorkerFailed("failed with an error")
