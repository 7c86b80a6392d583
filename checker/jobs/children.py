"""The processes that check uploads, the next one started before there is anything for it to do.

Python takes a second to load all that a check needs: as long as many a check itself.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

from checker.jobs.layout import environment
from checker.jobs.supervised import Ended, supervised


class Children:
    """Has processes check, each of them once.

    One thread starts them all, and stays until this object goes: to be kept as long as one of them
    checks, since what is to end with its parent ends with the thread that started it
    (PR_SET_PDEATHSIG in prctl(2)).
    """

    def __init__(self, cache: Path, ahead: bool = True) -> None:
        """Start nothing yet.

        Args:
            cache: Where results of parts are kept, for all children.
            ahead: Whether one is to wait for the next check.
        """
        self._cache, self._ahead = cache, ahead
        self._starter = ThreadPoolExecutor(1, "starts children")
        # For the thread that starts them alone.
        self._waiting: subprocess.Popen[bytes] | None = None

    def check(self, place: Path, seconds: float, cancelled: Callable[[], bool]) -> Ended:
        """Have a child check what lies in a folder; at the end none of its processes is left.

        Args:
            place: Laid out by `checker.jobs.layout`.
            seconds: By the clock, before it is stopped.
            cancelled: Whether it is no longer wanted; asked a few times a second.

        Raises:
            OSError: The system starts no process.
        """
        child = self._starter.submit(self._take).result()
        try:
            _tell(child, place)
            return supervised(child, seconds, cancelled)
        finally:
            # Not before: the next one would take processors from this one.
            self.get_ready()

    def get_ready(self) -> None:
        """Begin to start a child that waits for the next check."""
        self._starter.submit(self._fill)

    def close(self) -> None:
        """End the child that waits, and have no other one wait; those that check go on."""
        self._ahead = False
        self._starter.submit(self._drop).result()

    def _take(self) -> subprocess.Popen[bytes]:
        child, self._waiting = self._living(), None
        return child or self._start()

    def _fill(self) -> None:
        if self._ahead:
            self._waiting = self._living() or self._start()

    def _drop(self) -> None:
        if self._waiting is not None:
            self._waiting.kill()
            self._waiting.communicate()
            self._waiting = None

    def _living(self) -> subprocess.Popen[bytes] | None:
        """Return the child that waits, unless it has died meanwhile."""
        return self._waiting if self._waiting and self._waiting.poll() is None else None

    def _start(self) -> subprocess.Popen[bytes]:
        return subprocess.Popen(  # noqa: S603 - our own interpreter and module
            (sys.executable, "-P", "-m", "checker.jobs.checking_child", str(os.getpid())),
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            env=environment(self._cache),
            start_new_session=True,
        )


def _tell(child: subprocess.Popen[bytes], place: Path) -> None:
    """Tell a child where to work."""
    # One that has died says so by its exit code.
    with suppress(BrokenPipeError):
        if child.stdin is not None:
            child.stdin.write(json.dumps(str(place)).encode() + b"\n")
            child.stdin.close()
