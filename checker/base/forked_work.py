"""Work in a forked process that may crash: faster than a new interpreter.

Where the system has no forks, work is done in this process, which a crash then ends.
"""

from __future__ import annotations

import gc
import json
import math
import mmap
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from time import process_time
from typing import BinaryIO

from checker.base.exit_causes import cause_of, timeout_failure
from checker.base.parts import WorkerFailed
from checker.base.sandbox.task import code_of, end_with_parent
from checker.base.system import FORKS, limits_of, tighter

_RESULT_LIMIT = 200_000_000
"""Bytes."""
_HEAD = 8
"""Bytes of a result's length."""
_PIECE = 65_536
_LEAST = 1.0
"""Seconds that are worth beginning with."""
_BRIEF = 5
"""Seconds of processor time after which a work waits for the others; real files take one."""
_FOREVER = 1e9
"""Seconds."""
_GROWN = 100_000_000
"""Bytes by which works may make their fork grow before the next one is given a new fork."""


def as_entry(result: bytes | WorkerFailed) -> bytes:
    """Return a result in JSON as an entry of an answer, or in its place why there is none."""
    return json.dumps(result.entry).encode() if isinstance(result, WorkerFailed) else result


ForkRunner = Callable[[Sequence[Callable[[], bytes]]], list[bytes | WorkerFailed]]
"""Does work in forks: `run_all_in_forks` with its limits given."""


def run_in_fork(work: Callable[[], bytes], seconds: int) -> bytes | WorkerFailed:
    """Return what `work` returns in a fork of this process.

    Args:
        work: Called in the fork. This process must have no threads.
        seconds: Seconds of processor time.
    """
    if not FORKS:
        return _done_here(work, seconds)
    read, code = _forked([work], seconds, math.inf)
    return read[0] if read and code == 0 else _cause(code, seconds)


def _done_here(work: Callable[[], bytes], seconds: int) -> bytes | WorkerFailed:
    try:
        return work()
    except Exception as error:  # noqa: BLE001 - the works after it continue
        return _cause(code_of(error), seconds)


def forks_time() -> float:
    """Return the seconds of processor time that the forks of this process have taken so far."""
    times = os.times()
    return times.children_user + times.children_system


def run_all_in_forks(
    works: Sequence[Callable[[], bytes]], seconds: int, until: float, late: str
) -> list[bytes | WorkerFailed]:
    """Return what each of several works returns in a fork; a crash of one leaves the others.

    They share a fork, since a new one takes as long as a small file. Where it ends, the work at
    which it did is tried again, the first in its own fork. Those that take long are done
    after all others, so that they take time from one another alone.

    Args:
        works: See `run_in_fork`.
        seconds: Seconds of processor time, for each.
        until: The end of the time for all, by `forks_time`; none is started in its last second.
        late: The reason why those that are left then have no result.
    """
    if not FORKS:
        return [_done_here(work, seconds) for work in works]
    brief = min(_BRIEF, seconds)
    results = _in_turn(works, brief, until, late)
    if brief < seconds:
        slow = [number for number, result in enumerate(results) if result == timeout_failure(brief)]
        again = _in_turn([works[number] for number in slow], seconds, until, late)
        for number, result in zip(slow, again, strict=True):
            results[number] = result
    return results


def _in_turn(
    works: Sequence[Callable[[], bytes]], seconds: int, until: float, late: str
) -> list[bytes | WorkerFailed]:
    results: list[bytes | WorkerFailed] = []
    while len(results) < len(works):
        if until - forks_time() < _LEAST:
            return results + [WorkerFailed(late)] * (len(works) - len(results))
        read, code = _forked(works[len(results) :], seconds, until - forks_time())
        in_time = until - forks_time() >= _LEAST
        results += read or [_cause(code, seconds) if in_time else WorkerFailed(late)]
    return results


def _forked(
    works: Sequence[Callable[[], bytes]], seconds: int, all_seconds: float
) -> tuple[list[bytes], int]:
    """Do works in one fork; return the results of those that it finished, and its exit code."""
    if sys.platform == "win32":
        raise OSError("Windows has no forks")
    results_from, results_to = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(results_from)
        os._exit(_work(works, seconds, all_seconds, results_to))
    os.close(results_to)
    with os.fdopen(results_from, "rb") as pipe:
        results = list(islice(_whole(pipe), len(works)))
        while pipe.read(_PIECE):  # unexpected output
            pass
    return results, os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def _whole(pipe: BinaryIO) -> Iterator[bytes]:
    """Yield results as `_work` writes them, except the one that the fork did not finish."""
    while len(head := pipe.read(_HEAD)) == _HEAD:
        length = int.from_bytes(head, "big")
        result = pipe.read(length) if length <= _RESULT_LIMIT else b""
        if len(result) < length:
            return
        yield result


def _work(works: Sequence[Callable[[], bytes]], seconds: int, all_seconds: float, to: int) -> int:
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
                    if all_seconds - process_time() < _LEAST or _memory() - had > _GROWN:
                        break
                _allow(seconds, all_seconds)
                result = work()
                pipe.write(len(result).to_bytes(_HEAD, "big") + result)
                pipe.flush()
                del result
    except BaseException as error:  # noqa: BLE001 - it must not continue as its parent
        return code_of(error)
    return 0


def _allow(seconds: int, all_seconds: float) -> None:
    """Let this process run for so many seconds of processor time, or to the end of all."""
    end = min(process_time() + seconds, all_seconds)
    if sys.platform == "win32":
        return
    import resource

    soft, hard = math.ceil(min(end, _FOREVER)), resource.getrlimit(resource.RLIMIT_CPU)[1]
    resource.setrlimit(resource.RLIMIT_CPU, (tighter(hard, max(soft, 1)), hard))


def _memory() -> int:
    """Return the bytes of address space of this process; 0 if the system does not state it."""
    try:
        return int(Path("/proc/self/statm").read_text("ascii").split()[0]) * mmap.PAGESIZE
    except OSError:
        return 0


def _cause(code: int, seconds: int) -> WorkerFailed:
    return cause_of(code, seconds, limits_of("RLIMIT_AS")[0])
