"""Work in a forked process that may die: quicker than a new interpreter."""

from __future__ import annotations

import gc
import math
import os
import resource
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from time import monotonic, process_time
from typing import BinaryIO

from checker.base.exit_causes import cause_of
from checker.base.parts import WorkerFailed
from checker.base.sandbox.task import code_of, end_with_parent, tighter

_RESULT_LIMIT = 200_000_000
"""Bytes."""
_HEAD = 8
"""Bytes of a result's length."""
_PIECE = 65_536
_LEAST = 1.0
"""Seconds that are worth beginning with."""
_GROWN = 100_000_000
"""Bytes by which works may make their fork grow before the next one is given a new fork."""


ForkRunner = Callable[[Sequence[Callable[[], bytes]]], list[bytes | WorkerFailed]]
"""Does work in forks: `in_forks` with its limits given."""


def in_fork(work: Callable[[], bytes], seconds: int) -> bytes | WorkerFailed:
    """Return what `work` returns in a fork of this process.

    Args:
        work: Called in the fork. This process must have no threads.
        seconds: Of processor time.
    """
    read, code = _forked([work], seconds, math.inf)
    return read[0] if read and code == 0 else _cause(code, seconds)


def in_forks(
    works: Sequence[Callable[[], bytes]], seconds: int, until: float, late: str
) -> list[bytes | WorkerFailed]:
    """Return what each of several works returns in a fork; one that dies takes no other with it.

    They share a fork, since a new one takes as long as a small file. Where it ends, the work at
    which it did is tried once more, the first in a fork of its own.

    Args:
        works: See `in_fork`.
        seconds: Of processor time, for each.
        until: When the time for all ends, by `time.monotonic`; none is begun in its last second.
        late: Why those that are left then have no result.
    """
    results: list[bytes | WorkerFailed] = []
    while len(results) < len(works):
        if until - monotonic() < _LEAST:
            return results + [WorkerFailed(late, momentary=True)] * (len(works) - len(results))
        read, code = _forked(works[len(results) :], seconds, until)
        in_time = until - monotonic() >= _LEAST
        results += read or [
            _cause(code, seconds) if in_time else WorkerFailed(late, momentary=True)
        ]
    return results


def _forked(
    works: Sequence[Callable[[], bytes]], seconds: int, until: float
) -> tuple[list[bytes], int]:
    """Do works in one fork; return the results of those that it finished, and its exit code."""
    results_from, results_to = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(results_from)
        os._exit(_work(works, seconds, until, results_to))
    os.close(results_to)
    with os.fdopen(results_from, "rb") as pipe:
        results = list(islice(_whole(pipe), len(works)))
        while pipe.read(_PIECE):  # what nobody expects
            pass
    return results, os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def _whole(pipe: BinaryIO) -> Iterator[bytes]:
    """Yield results as `_work` writes them, but for the one that the fork did not finish."""
    while len(head := pipe.read(_HEAD)) == _HEAD:
        length = int.from_bytes(head, "big")
        result = pipe.read(length) if length <= _RESULT_LIMIT else b""
        if len(result) < length:
            return
        yield result


def _work(works: Sequence[Callable[[], bytes]], seconds: int, until: float, to: int) -> int:
    """Be the fork; return its exit code."""
    end_with_parent()
    gc.freeze()
    had = _memory()
    try:
        with os.fdopen(to, "wb") as pipe:
            for number, work in enumerate(works):
                if number:
                    # This work is to find as much memory as the first one did.
                    gc.collect()
                    if until - monotonic() < _LEAST or _memory() - had > _GROWN:
                        break
                _allow(seconds, until)
                result = work()
                pipe.write(len(result).to_bytes(_HEAD, "big") + result)
                pipe.flush()
                del result
    except BaseException as error:  # noqa: BLE001 - it must not go on as its parent
        return code_of(error)
    return 0


def _allow(seconds: int, until: float) -> None:
    """Let this process go on for so many seconds of processor time, or until it is too late."""
    left = min(float(seconds), until - monotonic())
    soft, hard = math.ceil(process_time() + left), resource.getrlimit(resource.RLIMIT_CPU)[1]
    resource.setrlimit(resource.RLIMIT_CPU, (tighter(hard, max(soft, 1)), hard))


def _memory() -> int:
    """Return the bytes of address space of this process; 0 where the system does not say."""
    try:
        return int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    except OSError:
        return 0


def _cause(code: int, seconds: int) -> WorkerFailed:
    return cause_of(code, seconds, resource.getrlimit(resource.RLIMIT_AS)[0])
