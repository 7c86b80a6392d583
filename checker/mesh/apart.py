"""Work in a forked process that may die: quicker than a new interpreter for each file."""

from __future__ import annotations

import os
import resource
import signal
from collections.abc import Callable
from time import monotonic

from checker.confined import end_with_parent
from checker.record import record

_OUT_OF_MEMORY, _FAILED = 71, 70
"""Exit codes, as in sysexits.h: EX_OSERR, EX_SOFTWARE."""


@record()
class Ended:
    """No result came; the reason ends a sentence whose subject is the work."""

    reason: str


def apart(work: Callable[[], bytes], seconds: int) -> bytes | Ended:
    """Return what `work` returns in a fork of this process.

    Args:
        work: Called in the fork. This process must have no threads.
        seconds: Of processor time.
    """
    result_from, result_to = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(result_from)
        os._exit(_work(work, seconds, result_to))
    os.close(result_to)
    with os.fdopen(result_from, "rb") as pipe:
        result = pipe.read()
    code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    return result if code == 0 else Ended(_cause(code, seconds))


def apart_until(
    work: Callable[[], bytes], seconds: int, until: float, for_all: float
) -> bytes | Ended:
    """Return what `work` returns in a fork, while there is time for one more of its kind.

    Args:
        work: See `apart`.
        seconds: Of processor time, at most.
        until: When the time for all ends, by `time.monotonic`.
        for_all: Seconds that all together had, for the reason.
    """
    left = min(seconds, int(until - monotonic()))
    if left < 1:
        return Ended(f"was not read: the others took {for_all:g} s")
    return apart(work, left)


def _work(work: Callable[[], bytes], seconds: int, result_to: int) -> int:
    """Be the fork; return its exit code."""
    end_with_parent()
    try:
        hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, hard))
        with os.fdopen(result_to, "wb") as pipe:
            pipe.write(work())
    except MemoryError:
        return _OUT_OF_MEMORY
    except BaseException:  # noqa: BLE001 - whatever it is, the fork must not go on as its parent
        return _FAILED
    return 0


def _cause(code: int, seconds: int) -> str:
    if code == _OUT_OF_MEMORY:
        return "needs more memory than it may have"
    if code == -signal.SIGXCPU:
        return f"needs more than {seconds} s of processor time"
    if code < 0:
        return f"ended its reader in a crash (signal {-code})"
    return "made its reader fail"
