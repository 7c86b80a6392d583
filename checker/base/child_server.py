"""A process with limits that answers one request after the other, so that it loads but once."""

from __future__ import annotations

import os
import select
import socket
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from time import monotonic
from typing import BinaryIO

from checker.base import child_process
from checker.base.child_process import Child, Limits, cause_of, overdue, written_in
from checker.base.errors import WorkerFailed
from checker.base.sandbox import files as handed
from checker.base.sandbox.files import Content

_ENDS_SECONDS = 5.0
"""Until the exit code of a process that has died is known, at most."""


class Asked:
    """A request to a server, and the answer once it is there."""

    def __init__(self, child: Child, said: BinaryIO, done: int) -> None:
        """Take it over.

        Args:
            child: The server's process.
            said: Takes the answer.
            done: Descriptor from which a byte comes when the answer is whole.
        """
        self._child, self._said, self._done = child, said, done
        self._deadline = monotonic() + child.limits.clock_seconds

    def answer(self) -> bytes | WorkerFailed:
        """Wait for the answer; a process that takes too long is stopped."""
        if self._said.closed:
            return WorkerFailed("was given up")
        try:
            poll = select.poll()
            poll.register(self._done, select.POLLIN)
            if not poll.poll(max(0.0, self._deadline - monotonic()) * 1000.0):
                self._child.stop()
                return overdue(self._child.limits)
            if not os.read(self._done, 1):
                self._child.ends(_ENDS_SECONDS)
                return cause_of(self._child.code, self._child.limits)
            found = written_in(self._said, child_process.ANSWER_LIMIT)
            return found if isinstance(found, WorkerFailed) else found[0]
        finally:
            self.stop()

    def stop(self) -> None:
        """Want no answer any more; the process goes on for others."""
        if not self._said.closed:
            self._said.close()
            os.close(self._done)


class Server:
    """Starts its process when it is first asked; one that has died is started anew."""

    def __init__(self, module: str, limits: Limits) -> None:
        """Start nothing yet.

        Args:
            module: As of a `Child`.
            limits: What the process may use for all requests; by the clock, for each.
        """
        self._module, self._limits = module, limits
        self._child: Child | None = None
        self._wire: socket.socket | None = None

    @property
    def alive(self) -> bool:
        """Whether its process waits for requests, or works at one."""
        return self._child is not None and self._child.alive

    def start(self) -> Server:
        """Start the process, if there is none."""
        if not self.alive:
            self.stop()
            self._wire, theirs = socket.socketpair()
            with theirs:
                self._child = Child(self._module, None, self._limits, wire=theirs)
        return self

    def give(self, request: bytes, contents: Iterable[tuple[str, Content]] = ()) -> Asked:
        """Bring a request; it is answered after those before it."""
        self.start()
        assert self._child is not None  # noqa: S101 - for type checkers
        assert self._wire is not None  # noqa: S101
        done, theirs = os.pipe()
        # No names: one that is killed leaves none, and nobody else can open them.
        said = tempfile.TemporaryFile()  # noqa: SIM115 - closed by who asks
        asked = Asked(self._child, said, done)
        try:
            with tempfile.TemporaryFile() as file:
                handed.write(file, request, contents)
                # One that has died says why when it is asked for its answer.
                with suppress(OSError):
                    socket.send_fds(self._wire, [b"!"], [file.fileno(), said.fileno(), theirs])
        except BaseException:  # such as a full disk
            asked.stop()
            raise
        finally:
            os.close(theirs)
        return asked

    def stop(self) -> None:
        """End the process, whatever it does."""
        if self._child is not None and self._wire is not None:
            self._child.stop()
            self._wire.close()
            self._child = self._wire = None
