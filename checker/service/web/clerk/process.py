"""A clerk in a process of its own: what an interpreter does for others is not waited for.

To read the index of an archive, to have it written and to order its check takes as long as to
receive it; a second processor can do the one while the first does the other.
"""

from __future__ import annotations

import asyncio
import socket
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import count
from time import monotonic
from typing import Any

from checker.service.web.clerk.port import Slip
from checker.service.web.clerk.wire import answer_from_line, id_in, slip_to_line
from checker.service.web.refusal import Refused

_PIECE = 65_536
_END = 1.0
"""Seconds that a killed process has to end."""
_AHEAD = 64
"""Uploads that a process is told of before it answers: so many fit into the socket at once, and who
writes never waits for it."""
_PATIENCE = 45.0
"""Seconds until an answer is no longer waited for; a hundred uploads at once take one, and proxies
wait for 60."""


@dataclass(eq=False)
class _Running:
    """A process that takes uploads.

    Attributes:
        wire: Where it is told of them, and answers.
        waiting: For answers, by the number of the upload.
        places: For uploads that it is told of.
        heard: The beginning of an answer.
        heard_at: When it answered last, by `monotonic`.
        begun: Whether answers are listened for.
    """

    process: subprocess.Popen[bytes]
    wire: socket.socket
    waiting: dict[int, asyncio.Future[Mapping[str, Any]]] = field(default_factory=dict)
    numbers: Iterator[int] = field(default_factory=count)
    places: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(_AHEAD))
    heard: bytes = b""
    heard_at: float = 0.0
    begun: bool = False


class ProcessClerk:
    """Has a process take uploads: a `Clerk`, used by one event loop. It starts anew if it dies.

    Attributes:
        patience: Seconds to wait for an answer.
    """

    def __init__(self, command: Sequence[str], patience: float = _PATIENCE) -> None:
        """Start no process yet.

        Args:
            command: Starts it; the descriptor of its socket is added.
            patience: Seconds to wait for an answer.
        """
        self._command = command
        self.patience = patience
        self._running: _Running | None = None

    def start(self) -> None:
        """Start the process, if there is none: it loads what it needs while nothing has come."""
        self._ready()

    @property
    def pid(self) -> int | None:
        """Of the process; None if there is none."""
        return self._running.process.pid if self._running is not None else None

    def stop(self) -> None:
        """End the process."""
        if self._running is not None:
            self._lose(self._running)

    async def take(self, slip: Slip) -> str:
        """See `Clerk.take`.

        Raises:
            Refused: Also where the process dies or does not answer: nobody knows whether the
                check is ordered.
        """
        running, began = self._ready(), monotonic()
        try:
            said = await asyncio.wait_for(self._answer(running, slip), self.patience)
        except TimeoutError:
            # Where others were answered meanwhile, it does not hang.
            if running.heard_at < began:
                self._lose(running)
            raise _lost("did not take the upload in time") from None
        return id_in(said)

    async def _answer(self, running: _Running, slip: Slip) -> Mapping[str, Any]:
        """Tell a process of an upload, and wait for what it answers."""
        await running.places.acquire()
        if self._running is not running:
            running.places.release()
            raise _lost("was interrupted while it took the upload")
        loop = asyncio.get_running_loop()
        if not running.begun:
            running.begun = True
            loop.add_reader(running.wire, self._listen, running)
        answer: asyncio.Future[Mapping[str, Any]] = loop.create_future()
        number = next(running.numbers)
        running.waiting[number] = answer
        try:
            running.wire.sendall(slip_to_line(number, slip))
        except OSError:
            self._lose(running)
        return await answer

    def _ready(self) -> _Running:
        if self._running is None:
            ours, theirs = socket.socketpair()
            with theirs:
                process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
                    [*self._command, str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    pass_fds=[theirs.fileno()],
                )
            self._running = _Running(process, ours)
        return self._running

    def _listen(self, running: _Running) -> None:
        """Give answers to those who wait for them."""
        try:
            heard = running.wire.recv(_PIECE)
        except OSError:
            heard = b""
        if not heard:
            self._lose(running)
            return
        running.heard_at = monotonic()
        *lines, running.heard = (running.heard + heard).split(b"\n")
        for line in lines:
            number, said = answer_from_line(line)
            answer = running.waiting.pop(number)
            running.places.release()
            if not answer.done():  # who asked may have gone
                answer.set_result(said)

    def _lose(self, running: _Running) -> None:
        """Know nothing more of a process, and tell those who wait for it."""
        if self._running is not running:
            return
        self._running = None
        if running.begun:
            asyncio.get_running_loop().remove_reader(running.wire)
        running.wire.close()
        running.process.kill()
        with suppress(subprocess.TimeoutExpired):  # a disk that hangs keeps what is killed
            running.process.wait(_END)
        for answer in running.waiting.values():
            running.places.release()
            if not answer.done():
                answer.set_exception(_lost("was interrupted while it took the upload"))
        running.waiting.clear()


def _lost(reason: str) -> Refused:
    return Refused(
        503,
        f"The service {reason}.",
        "Send it again.",
        "clerk",
        {"Retry-After": "5"},
    )
