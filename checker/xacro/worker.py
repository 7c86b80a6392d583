"""Expands xacro files in a child process: the module behind `checker.confined`.

It is given texts and opens no file. Each file is expanded in a process of its own.
"""

from __future__ import annotations

import json
from time import monotonic
from typing import Any

from checker.mesh.apart import Ended, apart
from checker.sandbox.files import NO_FILES, Files

SECONDS_FOR_ONE = 5
"""Of processor time; the largest real file takes less than 1 s."""
SECONDS_FOR_ALL = 30.0
_SHORTEST = 1


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Expand files.

    Args:
        request: JSON: `texts` by path, `absent` paths, `faulty` paths with what is wrong there,
            `beyond` names of packages that are not at hand, and `jobs`: each a `file` and `args`.

    Returns:
        JSON: what became of each job (see `checker.xacro.processor`), in the same order.
    """
    from checker.xacro import guard, processor

    given = json.loads(request)
    until = monotonic() + SECONDS_FOR_ALL

    def work(job: Any) -> bytes:
        guard.put_up()
        return json.dumps(processor.expand(given, job["file"], job["args"])).encode()

    done = []
    for job in given["jobs"]:
        seconds = min(SECONDS_FOR_ONE, int(until - monotonic()))
        if seconds < _SHORTEST:
            done.append({"unread": f"the other files took {SECONDS_FOR_ALL:g} s"})
            continue
        result = apart(lambda job=job: work(job), seconds)  # type: ignore[misc]
        if isinstance(result, Ended):
            done.append({"kind": "limit", "message": f"expanding it {result.reason}"})
        else:
            done.append(json.loads(result))
    return json.dumps(done).encode()
