"""Has the indexes of archives read by processes that have nothing of the service."""

from __future__ import annotations

import json
import os
import shutil
import socket
import tempfile
from pathlib import Path
from threading import Lock
from time import monotonic
from typing import Any

from checker.base.child_process import from_json
from checker.base.errors import UnreadableInput
from checker.base.files import open_file
from checker.base.resources import PACKAGE
from checker.base.sandbox.launcher import Launcher, Order, OwnLauncher

_MODULE = f"{PACKAGE}.package.archives.index_process"
_SECONDS, _PROCESSOR_SECONDS = 30.0, 30
"""For one index."""
_MEMORY = 500_000_000
"""Bytes of address space."""
_ANSWER_LIMIT = 10_000
_WORDS_LIMIT = 1_000
_WAITING = 4
"""Processes that wait for an archive, each for one alone."""
_AGAIN = "upload it again, or with fewer files"


class _Reader:
    """A process that reads one index."""

    def __init__(self, launcher: Launcher) -> None:
        """Start it."""
        self._wire, theirs = socket.socketpair()
        order = Order(_MODULE, _PROCESSOR_SECONDS, _MEMORY, serves=True)
        with theirs, theirs.makefile("rb") as request, tempfile.TemporaryFile() as answer:
            self._started = launcher.start(order, request, answer)

    def ask(self, archive: Path, name: str) -> Any:
        """Return what it says of an archive.

        Raises:
            OSError: It does not answer in time, or the archive cannot be opened.
            ValueError: It answers with nonsense.
        """
        # A copy, of which nothing leads to what is kept.
        with open_file(archive) as file, tempfile.TemporaryFile(dir=archive.parent) as copy:
            shutil.copyfileobj(file, copy)
            copy.seek(0)
            message = json.dumps({"name": name}).encode()
            socket.send_fds(self._wire, [message], [copy.fileno()])
        return from_json(self._heard())

    def _heard(self) -> bytes:
        deadline, data = monotonic() + _SECONDS, b""
        while not data.endswith(b"\n"):
            self._wire.settimeout(max(0.01, deadline - monotonic()))
            piece = self._wire.recv(_ANSWER_LIMIT)
            data += piece
            if not piece or len(data) > _ANSWER_LIMIT:
                raise ValueError("no answer")
        return data

    def stop(self) -> None:
        """End it."""
        self._wire.close()
        for descriptor in (self._started.input, self._started.code):
            os.close(descriptor)


class ArchiveIndexes:
    """Looks at archives, many at once if need be: each process at one, and then no more."""

    def __init__(self) -> None:
        """Start nothing yet."""
        self._waiting: list[_Reader] = []
        self._launcher: OwnLauncher | None = None
        self._lock = Lock()

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
        """Look at the index of an archive.

        Args:
            archive: Where it lies.
            name: As its sender calls it, made safe.

        Raises:
            UnreadableInput: It could do harm, is damaged, or takes down who reads it.
        """
        try:
            answer = self._asked(archive, name)
        except (OSError, ValueError):
            raise UnreadableInput(archive, "has an index that cannot be read", _AGAIN) from None
        match answer:
            case {"reason": str(reason), "advice": str(advice)}:
                raise UnreadableInput(archive, reason[:_WORDS_LIMIT], advice[:_WORDS_LIMIT])
            case {}:
                return
        raise UnreadableInput(archive, "has an index that cannot be read", _AGAIN)

    def _asked(self, archive: Path, name: str) -> Any:
        self.start()
        with self._lock:
            reader = self._waiting.pop(0)
        try:
            return reader.ask(archive, name)
        finally:
            reader.stop()
