"""Expands xacro files in a child process: the module behind `checker.base.child_process`.

It is given texts and opens no file. Each file is expanded in its own process.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache
from typing import Any

from checker.base.forked_work import forks_time, run_in_fork
from checker.base.parts import WorkerFailed
from checker.base.sandbox import seccomp
from checker.base.sandbox.files import NO_FILES, Files
from checker.base.system import tighten

ANSWER_LIMIT = 60_000_000
"""Bytes that the process may write."""


@cache
def put_up() -> None:
    """Permanently take from this process all that expanding a text does not need.

    Once: afterwards it cannot do it again, where several texts share a process.

    The expander checks expressions too. This is the layer behind it, for what slips through.
    """
    os.environ.clear()
    tighten("RLIMIT_NOFILE", 0, 0)
    tighten("RLIMIT_NPROC", 0, 0)
    tighten("RLIMIT_FSIZE", ANSWER_LIMIT, ANSWER_LIMIT)
    # The kernel holds native code as well, which no audit hook sees; where it does not, the rest
    # still holds Python.
    with suppress(seccomp.NotHeld):
        seccomp.gain_nothing()
        seccomp.forbid_calls(opens=False, changes=False, signals=False)
    sys.addaudithook(_refuser())


def _refuser() -> Callable[[str, object], None]:
    refusal = PermissionError

    def refuse(event: str, _: object) -> None:
        # The names are in the code itself: a set elsewhere could be changed.
        if event not in ("compile", "exec", "builtins.id", "sys._getframe"):
            raise refusal(f"an expression may not do this ({event})")

    return refuse


SECONDS_FOR_ONE = 5
"""Seconds of processor time; the largest real file takes less than 1 s."""
SECONDS_FOR_ALL = 30.0
"""Likewise, for the files of one request."""
_SHORTEST = 1


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Expand files.

    Args:
        request: JSON: `texts` by path, `absent` paths, `faulty` paths with what is wrong there,
            `beyond` names of unavailable packages, and `items`: each a `file` and `args`,
            whether it is expanded `as_melodic`, and the `call` that is added to it.

    Returns:
        JSON: the result of each job (see `checker.formats.xacro.processor`), in the same order.
    """
    from checker.formats.xacro import processor

    data = json.loads(request)
    until = forks_time() + SECONDS_FOR_ALL

    def work(job: Any) -> bytes:
        put_up()
        as_melodic = bool(job.get("as_melodic"))
        call = job.get("call")
        done = processor.expand(data, job["file"], job["args"], as_melodic=as_melodic, call=call)
        return json.dumps(done).encode()

    done: list[Mapping[str, object]] = []
    for job in data["items"]:
        seconds = min(SECONDS_FOR_ONE, int(until - forks_time()))
        if seconds < _SHORTEST:
            done.append({"unread": f"the other files took {SECONDS_FOR_ALL:g} s of processor time"})
            continue
        result = run_in_fork(lambda job=job: work(job), seconds)  # type: ignore[misc]
        if isinstance(result, WorkerFailed) and result.momentary:
            done.append(result.entry)
        elif isinstance(result, WorkerFailed):
            done.append({"kind": "limit", "message": f"expanding it {result.reason}"})
        else:
            done.append(json.loads(result))
    return json.dumps(done).encode()
