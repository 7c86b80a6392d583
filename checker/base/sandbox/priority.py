"""Lowers the priority of processes, as `nice` counts it (sched(7))."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from time import sleep

_LAST = 19
_TRIES, _SECONDS = 20, 0.1


def lower_priority(processes: Sequence[int], by: int) -> None:
    """Lower the priority of all threads of some processes; what has ended is ignored.

    Args:
        processes: Their ids, at least one; all of one session.
        by: The increase of their niceness.
    """
    if sys.platform == "win32":
        return
    for process in processes:
        with suppress(OSError):
            for path in Path(f"/proc/{process}/task").iterdir():
                thread = int(path.name)
                now = os.getpriority(os.PRIO_PROCESS, thread)
                os.setpriority(os.PRIO_PROCESS, thread, min(now + by, _LAST))
    with suppress(OSError):
        _stand_back_as_group(Path(f"/proc/{processes[-1]}/autogroup"), by)


def _stand_back_as_group(group: Path, by: int) -> None:
    """Lower the priority of a session: where each is a group, niceness counts within it alone.

    Without root, the system grants one request in a tenth of a second on the whole machine.

    Raises:
        OSError: The system has no such groups, or does not let us.
    """
    now = int(group.read_text("ascii").split()[-1])
    for _ in range(_TRIES):
        try:
            group.write_text(str(min(now + by, _LAST)), encoding="ascii")
        except BlockingIOError:
            sleep(_SECONDS)
        else:
            return
