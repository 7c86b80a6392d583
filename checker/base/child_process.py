"""Work on hostile or heavy input in a sandboxed process with limits; the caller survives its death.

The process runs one function of one module: `answer(request, files)`. Messages in both directions
are bytes (such as JSON), never pickles: a compromised process must not compromise its caller. It is
started in the sandbox (`checker.base.sandbox`), and given no path.
"""

from __future__ import annotations

import json
import os
import signal
import tempfile
from collections.abc import Iterable
from pathlib import Path
from time import monotonic
from typing import Any, BinaryIO, cast

from checker.base.exit_causes import cause_of
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.sandbox import files as handed
from checker.base.sandbox.files import Content, Files
from checker.base.sandbox.launcher import Launcher, Order, launcher
from checker.base.sandbox.plain_launcher import PlainLauncher
from checker.base.sandbox.task import FAILED
from checker.base.system import FORKS

ANSWER_LIMIT = 200_000_000
"""Bytes; an answer has at least one."""
_STARTUP_SECONDS = 60.0
"""For the imports, on a machine that does something else too."""
_CLOCK = 10.0
"""Seconds by the clock for one of processor time: a busy machine is no reason to stop anything."""
_ENDS_SECONDS = 5.0
"""Until a process that is killed has ended, at most."""


class Limits(Record):
    """Resource limits of a process.

    Attributes:
        seconds: Seconds of processor time. By the clock it may take far longer (`clock_seconds`),
            so that the load of the machine does not decide what is checked.
        memory: Bytes of address space.
        draws: Whether it may use graphics cards.
    """

    seconds: float
    memory: int = 1_000_000_000
    draws: bool = False

    @property
    def clock_seconds(self) -> float:
        """Limit of real time, in seconds."""
        return _CLOCK * self.seconds + _STARTUP_SECONDS


class Child:
    """A process that works while the caller does something else."""

    def __init__(
        self,
        module: str,
        request: bytes | None,
        limits: Limits,
        contents: Iterable[tuple[str, Content]] = (),
        starter: Launcher | None = None,
        *,
        works: bool = False,
        folder: Path | None = None,
        done: int | None = None,
    ) -> None:
        """Start it.

        Args:
            module: Full name of the module whose `answer` does the work. Its `prepare`, if it has
                one, is called before the request is there.
            request: What `answer` is given; None when `give` brings it later.
            limits: What the process may use.
            contents: Files that go with the request: their names, and what is in them.
            starter: Starts it; that of this process when None.
            works: Whether it writes into the working folder, and requests processes itself.
            folder: The folder for request and answer; that of temporary files when None.
            done: The pipe on which it reports that an answer is there, if it lasts (see
                `child_server`).
        """
        self.limits = limits
        self.deadline = monotonic() + limits.clock_seconds
        # No names: one that is killed leaves none, and no other process can open them.
        self._request = cast("BinaryIO", tempfile.TemporaryFile(dir=folder))  # noqa: SIM115 - closed by `stop`
        self._answer = cast("BinaryIO", tempfile.TemporaryFile(dir=folder))  # noqa: SIM115
        order = Order(
            module,
            int(limits.seconds),
            limits.memory,
            works,
            limits.draws,
            lasts=done is not None,
        )
        # Kept, since all of its processes end with it.
        self._starter = starter or (launcher() if FORKS else PlainLauncher())
        more = () if done is None else (done,)
        self._started = self._starter.start(order, self._request, self._answer, *more)
        self.code: int | None = None
        """Its exit code once it has ended; of a signal, its negative number."""
        self._stopped = False
        if request is not None:
            try:
                self.give(request, contents)
            except BaseException:  # such as a full disk: no other code knows of the process
                self.stop()
                raise

    @property
    def alive(self) -> bool:
        """True if it has not ended."""
        return not self.ends(0.0)

    def give(self, request: bytes, contents: Iterable[tuple[str, Content]] = ()) -> Child:
        """Send the request to a process that was started without one; its time begins now."""
        self.deadline = monotonic() + self.limits.clock_seconds
        handed.write(self._request, request, contents)
        self._started.begin(b"!")
        return self

    def answer(self) -> bytes | WorkerFailed:
        """Wait for the answer."""
        try:
            if not self.ends(self.deadline - monotonic()):
                return overdue(self.limits)
            if self.code != 0:
                return cause_of(self.code, self.limits.seconds, self.limits.memory)
            answer = self.answered(ANSWER_LIMIT)
            return answer if isinstance(answer, WorkerFailed) else answer[0]
        finally:
            self.stop()

    @property
    def bytes_sent(self) -> int:
        """Bytes of its request, with the files that went with it."""
        return os.fstat(self._request.fileno()).st_size

    def ends(self, seconds: float) -> bool:
        """Wait for its end; False if it still runs after so many seconds."""
        if self._stopped:
            return True
        data = self._started.wait(seconds)
        if data is None:
            return False
        if self.code is None:
            self.code = _code(data)
        return True

    def answered(
        self, limit: int, start: int = 0, end: int | None = None
    ) -> tuple[bytes, Files] | WorkerFailed:
        """Return what it has written; the files can be read until it is stopped.

        Args:
            limit: Bytes of the answer; the files have their own limits.
            start: The offset at which the answer begins.
            end: The offset at which it ends; None for the end of the file.
        """
        size = os.fstat(self._answer.fileno()).st_size
        # A library may end the process with exit code 0 before anything is said.
        if size == 0:
            return WorkerFailed("ended without an answer")
        try:
            if not start <= (size if end is None else end) <= size:
                raise handed.Damaged("is cut off")
            answer, files = handed.read(self._answer.fileno(), limit, start, end)
        except handed.Damaged as damage:
            return WorkerFailed(f"sent an answer that {damage}")
        return (answer, files) if answer else WorkerFailed("ended without an answer")

    def stop(self) -> None:
        """End the process, whatever it does; nothing happens if it has ended."""
        if self._stopped:
            return
        self._started.kill()
        self.ends(_ENDS_SECONDS)
        self._stopped = True
        self._started.close()
        self._request.close()
        self._answer.close()


def ask(
    module: str, request: bytes, limits: Limits, contents: Iterable[tuple[str, Content]] = ()
) -> bytes | WorkerFailed:
    """Run a module in a process and wait for the answer; see `Child`."""
    return Child(module, request, limits, contents).answer()


NONSENSE = (AttributeError, IndexError, KeyError, TypeError, ValueError)
"""Exceptions that reading an answer in an unexpected form may raise."""


def from_json(answer: bytes) -> Any:
    """Return what an answer states as JSON; the answering process may be compromised.

    Raises:
        ValueError: It is no JSON, or nests too deeply.
    """
    try:
        return json.loads(answer)
    except RecursionError:
        raise ValueError("nests too deeply") from None


def _code(data: bytes) -> int | None:
    """Return the exit code that the launcher reports; the launcher may be compromised."""
    try:
        code = int(data)
    except ValueError:
        return None
    return code if code >= 0 or -code in {*signal.Signals} else FAILED


def overdue(limits: Limits) -> WorkerFailed:
    """Return what is stated about a process that was stopped."""
    return WorkerFailed(f"took longer than {limits.clock_seconds:g} s and was stopped", True)
