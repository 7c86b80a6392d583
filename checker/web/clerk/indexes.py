"""Has the indexes of archives read by processes that have nothing of the service."""

from __future__ import annotations

import json
import os
import socket
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from threading import Lock

from checker.errors import UnreadableInput
from checker.package.index_process import MESSAGE_LIMIT
from checker.package.reading import open_file
from checker.sandbox.launcher import Launcher, Order, OwnLauncher, Started

_MODULE = "checker.package.index_process"
_SECONDS, _PROCESSOR_SECONDS = 30.0, 3_600
"""For one index, by the clock; for a process that reads many, of processor time."""
_MEMORY = 500_000_000
"""Bytes of address space."""
_ANSWER_LIMIT = 10_000
_AGAIN = "upload it again, or with fewer files"


class _Reader:
    """A process that reads one index after the other."""

    def __init__(self, launcher: Launcher) -> None:
        """Start it."""
        self._wire, theirs = socket.socketpair()
        self._wire.settimeout(_SECONDS)
        order = Order(_MODULE, _PROCESSOR_SECONDS, _MEMORY, serves=True)
        with theirs, theirs.makefile("rb") as request, tempfile.TemporaryFile() as answer:
            self._started: Started = launcher.start(order, request, answer)

    def ask(self, archive: Path, name: str) -> object:
        """Return what it says of an archive.

        Raises:
            OSError: It does not answer, or the archive cannot be opened.
            ValueError: It answers with nonsense.
        """
        with open_file(archive) as file:
            message = json.dumps({"name": name}).encode()
            socket.send_fds(self._wire, [message[:MESSAGE_LIMIT]], [file.fileno()])
        said = b""
        while not said.endswith(b"\n"):
            piece = self._wire.recv(_ANSWER_LIMIT)
            said += piece
            if not piece or len(said) > _ANSWER_LIMIT:
                raise ValueError("no answer")
        try:
            return json.loads(said)
        except RecursionError:
            raise ValueError("no answer") from None

    def stop(self) -> None:
        """End it."""
        self._wire.close()
        for descriptor in (self._started.input, self._started.code):
            os.close(descriptor)


class Indexes:
    """Looks at archives, many at once if need be; each process looks at one at a time."""

    def __init__(self) -> None:
        """Start nothing yet."""
        self._free: list[_Reader] = []
        self._lock = Lock()

    def start(self) -> None:
        """Start a process, so that the first archive need not wait for it."""
        with self._reader():
            pass

    def check(self, archive: Path, name: str) -> None:
        """Look at the index of an archive.

        Args:
            archive: Where it lies.
            name: As its sender calls it.

        Raises:
            UnreadableInput: It could do harm, is damaged, or takes down who reads it.
        """
        try:
            with self._reader() as reader:
                said = reader.ask(archive, name)
        except (OSError, ValueError):
            raise UnreadableInput(archive, "has an index that cannot be read", _AGAIN) from None
        match said:
            case {"reason": str(reason), "advice": str(advice)}:
                raise UnreadableInput(archive, reason[:1_000], advice[:1_000])

    @contextmanager
    def _reader(self) -> Iterator[_Reader]:
        """Give a process; one that fails is not asked again."""
        with self._lock:
            reader = self._free.pop() if self._free else _Reader(self._launcher)
        try:
            yield reader
        except BaseException:
            reader.stop()
            raise
        with self._lock:
            self._free.append(reader)

    @cached_property
    def _launcher(self) -> OwnLauncher:
        return OwnLauncher()
