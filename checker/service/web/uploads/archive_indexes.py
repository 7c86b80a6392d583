"""Reads the indexes of archives in processes without access to the service."""

from __future__ import annotations

import errno
import json
import os
import select
import shutil
import signal
import socket
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from threading import RLock
from time import monotonic, sleep
from typing import Any

from checker.base.child_process import from_json
from checker.base.errors import UnreadableInput
from checker.base.files import open_file
from checker.base.resources import PACKAGE
from checker.base.sandbox.launcher import Launcher, Order, OwnLauncher
from checker.base.sandbox.task import DISTURBED, OUT_OF_MEMORY

_MODULE = f"{PACKAGE}.package.archives.index_process"
SECONDS, PROCESSOR_SECONDS = 60.0, 4
"""For one index: one of 5000 entries, or of 100 MB that contain 500, takes less than a second of a
processor; those that are made to be slow took five."""
_MEMORY = 500_000_000
"""Bytes of address space."""
_ANSWER_LIMIT = 10_000
_WORDS_LIMIT = 1_000
_WAITING = 4
"""Processes that wait for an archive, each for one alone."""
_CODE_LIMIT, _CODE_SECONDS = 20, 1.0
_PAUSE_SECONDS = 0.2
"""Before a second try."""
_UNREADABLE = "has an index that cannot be read"
_AGAIN = "upload it again, or with fewer files"
_PACK_AGAIN = "pack the package folder again, with an ordinary program and fewer files"


class _Reader:
    """A process that reads one index."""

    def __init__(self, launcher: Launcher) -> None:
        """Start it."""
        self._wire, theirs = socket.socketpair()
        order = Order(_MODULE, PROCESSOR_SECONDS, _MEMORY, serves=True)
        with theirs, theirs.makefile("rb") as request, tempfile.TemporaryFile() as answer:
            self._started = launcher.start(order, request, answer)

    def ask(self, archive: Path, name: str) -> Any:
        """Return what it states about an archive.

        Raises:
            TimeoutError: It does not answer in time.
            OSError: The archive cannot be opened or copied, or it died before the request.
            ValueError: It answers with nonsense, or has died.
        """
        # A copy, of which nothing leads to what is kept.
        with open_file(archive) as file, tempfile.TemporaryFile(dir=archive.parent) as copy:
            shutil.copyfileobj(file, copy)
            copy.seek(0)
            message = json.dumps({"name": name}).encode()
            socket.send_fds(self._wire, [message], [copy.fileno()])
        return from_json(self._heard())

    def _heard(self) -> bytes:
        deadline, data = monotonic() + SECONDS, b""
        while not data.endswith(b"\n"):
            self._wire.settimeout(max(0.01, deadline - monotonic()))
            piece = self._wire.recv(_ANSWER_LIMIT)
            data += piece
            if not piece or len(data) > _ANSWER_LIMIT:
                raise ValueError("no answer")
        return data

    def end(self) -> int | None:
        """Return its exit code, of a signal its negative number; None if it lives.

        Raises:
            OSError: It was killed, or its parent has died: an archive causes neither.
        """
        if not select.select([self._started.code], [], [], _CODE_SECONDS)[0]:
            return None
        data = os.read(self._started.code, _CODE_LIMIT)
        code = int(data) if data.removeprefix(b"-").isdigit() else -signal.SIGKILL
        if code in (-signal.SIGKILL, -signal.SIGTERM, DISTURBED):
            raise OSError(errno.EAGAIN, "the process that reads archives was killed")
        return code

    def stop(self) -> None:
        """End it."""
        self._wire.close()
        for descriptor in (self._started.input, self._started.code):
            os.close(descriptor)


class ArchiveIndexes:
    """Looks at archives, many at once if needed: each process at one, and then no more."""

    def __init__(self) -> None:
        """Start nothing yet."""
        self._waiting: list[_Reader] = []
        self._launcher: OwnLauncher | None = None
        self._lock = RLock()

    def start(self) -> None:
        """Start processes, so that the next archives need not wait for them.

        Raises:
            OSError: The system starts none.
        """
        with self._lock:
            if self._launcher is None or not self._launcher.alive:
                self._launcher = OwnLauncher(loaded=_MODULE)
                self._waiting.clear()
            while len(self._waiting) < _WAITING:
                self._waiting.append(_Reader(self._launcher))

    def check(self, archive: Path, name: str) -> None:
        """Look at the index of an archive; what fails of the system is tried again once.

        Args:
            archive: The path of the archive.
            name: The sender's name for it, made safe.

        Raises:
            UnreadableInput: It could do harm, is damaged, or crashes its reader.
            OSError: The disk or the system fails, which is no fault of the archive.
        """
        try:
            self._check(archive, name)
        except OSError:
            self._begin_anew()
            sleep(_PAUSE_SECONDS)
            self._check(archive, name)

    def _check(self, archive: Path, name: str) -> None:
        match self._asked(archive, name):
            case {"momentary": str(cause)}:
                raise OSError(errno.EAGAIN, cause[:_WORDS_LIMIT])
            case {"reason": str(reason), "advice": str(advice)}:
                raise UnreadableInput(archive, reason[:_WORDS_LIMIT], advice[:_WORDS_LIMIT])
            case {}:
                return
        raise UnreadableInput(archive, _UNREADABLE, _AGAIN)

    def _asked(self, archive: Path, name: str) -> Any:
        with self._lock:
            self.start()
            reader = self._waiting.pop(0)
        try:
            return reader.ask(archive, name)
        except TimeoutError:
            raise UnreadableInput(archive, _takes_more(f"{SECONDS:g} s"), _AGAIN) from None
        except ValueError:
            if limit := _LIMITS.get(reader.end()):
                raise UnreadableInput(archive, _takes_more(limit()), _PACK_AGAIN) from None
            raise UnreadableInput(archive, _UNREADABLE, _AGAIN) from None
        finally:
            reader.stop()

    def _begin_anew(self) -> None:
        """Discard waiting processes: the cause of one death may have killed them all."""
        with self._lock:
            while self._waiting:
                self._waiting.pop().stop()


_LIMITS: Mapping[int | None, Callable[[], str]] = {
    -signal.SIGXCPU: lambda: f"{PROCESSOR_SECONDS} s of processor time",
    OUT_OF_MEMORY: lambda: f"{_MEMORY / 1e6:g} MB of memory",
}
"""In words, by the exit code of a process that reaches them."""


def _takes_more(limit: str) -> str:
    return f"takes more than the {limit} allowed until its index is read"
