"""Processes whose parents have ended: they become children of the launcher, which ends them.

Without this, a process that leaves its session would go on after the check that it belongs to.
"""

from __future__ import annotations

import ctypes
import os
import signal
from collections.abc import Container
from contextlib import suppress
from time import monotonic

_PR_SET_CHILD_SUBREAPER = 36
_SECONDS = 5.0
"""For what makes new processes as fast as they are ended."""
_LIMIT = 100_000
"""Bytes of a list of processes."""


class Orphans:
    """Ends orphans, where the system tells of them (Linux with CONFIG_PROC_CHILDREN)."""

    def __init__(self) -> None:
        """Have orphans become children of this process; called before files are out of reach."""
        self._list = -1
        with suppress(OSError, AttributeError):
            if ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) == 0:
                id = os.getpid()
                self._list = os.open(f"/proc/{id}/task/{id}/children", os.O_RDONLY | os.O_CLOEXEC)

    def end(self, kept: Container[int]) -> None:
        """End all children but some, and those whom they leave behind.

        Args:
            kept: Ids of those that go on.
        """
        deadline = monotonic() + _SECONDS
        while monotonic() < deadline:
            orphans = [id for id in self._children() if id not in kept]
            if not orphans:
                return
            for id in orphans:
                with suppress(OSError):
                    os.kill(id, signal.SIGKILL)
                    os.waitpid(id, 0)

    def _children(self) -> list[int]:
        if self._list < 0:
            return []
        with suppress(OSError):
            return [int(id) for id in os.pread(self._list, _LIMIT, 0).split()]
        return []
