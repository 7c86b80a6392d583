"""The process that others are forked from: `python -m checker.base.sandbox.launcher_process`.

It is started with nothing of its parent's but a socket, enters its sandbox, and reads
no files of users. Each process that it starts runs one function of one module in the sandbox.

On the socket comes one JSON object a message (`Order` in `checker.base.sandbox.launcher`), with the
descriptors of the new process: its input, the file of its request, that of its answer, and a pipe
for its exit code; and where it lasts, one more to state that an answer is there. Closing the
other end of the input kills the process. When the socket closes, all of them end.
"""

from __future__ import annotations

import ctypes
import json
import os
import re
import resource
import select
import signal
import socket
import sys
from collections.abc import Container, Sequence
from contextlib import suppress
from time import monotonic
from typing import Any

from checker.base.sandbox.layers import ACCOUNT, NAMESPACES, Layer, Sandbox, enter
from checker.base.sandbox.priority import lower_priority
from checker.base.sandbox.task import FAILED, load_prepared, run

assert sys.platform != "win32"  # noqa: S101 - states to type checkers that it never runs there

# Processes whose parents have ended: they become children of the launcher, which ends them.
#
# Without this, a process that leaves its session would continue after the check that it belongs to.


_PR_SET_CHILD_SUBREAPER = 36
_SECONDS = 5.0
"""Time to end programs that start processes as fast as they are ended."""
_LIMIT = 100_000
"""Bytes of a list of processes."""


class Orphans:
    """Ends orphans, where the system lists them (Linux with CONFIG_PROC_CHILDREN)."""

    def __init__(self) -> None:
        """Make orphans children of this process; called before files are out of reach."""
        self._list = -1
        with suppress(OSError, AttributeError):
            if ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) == 0:
                id = os.getpid()
                self._list = os.open(f"/proc/{id}/task/{id}/children", os.O_RDONLY | os.O_CLOEXEC)

    def end(self, kept: Container[int]) -> None:
        """End all children but some, and those that they leave behind.

        Args:
            kept: Ids of those that continue.
        """
        deadline = monotonic() + _SECONDS
        while monotonic() < deadline:
            orphans = [id for id in self._children() if id not in kept]
            if not orphans:
                return
            for id in orphans:
                _end(id)
                with suppress(OSError):
                    os.waitpid(id, 0)

    def _children(self) -> list[int]:
        if self._list < 0:
            return []
        with suppress(OSError):
            return [int(id) for id in os.pread(self._list, _LIMIT, 0).split()]
        return []


MESSAGE_LIMIT = 4096
"""Bytes of one message."""
DESCRIPTORS = 4
"""Number of descriptors with an order; one more where the process lasts."""
_MOST_DESCRIPTORS = 1_048_576
"""Greatest number of descriptors with the order to start a process."""
_GONE = select.POLLHUP | select.POLLERR | select.POLLNVAL
_TELL_SECONDS = 0.5
_PROCESSES_LIMIT = 512
_COUNTS_BY_NAMESPACE = (5, 14)


class _Process:
    """A process that was started: its input, and the target of its exit code."""

    def __init__(self, id: int, input: int, code: int) -> None:
        self.id, self.input, self.code = id, input, code


class LauncherProcess:
    """Starts processes until the socket closes."""

    def __init__(self, control: socket.socket, sandbox: Sandbox) -> None:
        """Enter the sandbox, and return the active layers."""
        # A process in the sandbox requests others by a socket of its own.
        self._inner_client, inner = socket.socketpair()
        self._controls = {control.fileno(): control, inner.fileno(): inner}
        self._outer = control.fileno()
        self._sandbox = sandbox
        self._processes: dict[int, _Process] = {}
        self._poll = select.poll()
        self._woken, wake = os.pipe()
        os.set_blocking(wake, False)
        os.set_blocking(self._woken, False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.signal(signal.SIGALRM, _give_up)
        signal.set_wakeup_fd(wake, warn_on_full_buffer=False)
        self._orphans = Orphans()
        layers = enter(sandbox)
        _limit_processes(layers)
        data = json.dumps([[layer.name, layer.held, layer.words, layer.hides] for layer in layers])
        control.sendall(data.encode() + b"\n")
        for descriptor in (*self._controls, self._woken):
            self._poll.register(descriptor, select.POLLIN)

    def serve(self) -> None:
        """Start and end processes as requested, until the socket closes."""
        while True:
            for descriptor, event in self._poll.poll():
                if descriptor == self._woken:
                    self._reap()
                elif descriptor in self._controls:
                    if not self._heed(self._controls[descriptor]) and descriptor == self._outer:
                        self._orphans.end(())
                        return
                elif event & _GONE:
                    self._kill(descriptor)

    def _heed(self, control: socket.socket) -> bool:
        """Execute one message; False if there are no more."""
        try:
            message, descriptors, _, _ = socket.recv_fds(control, MESSAGE_LIMIT, DESCRIPTORS + 1)
        except ConnectionError:  # closed before all that was said to it was read
            message, descriptors = b"", []
        if message and len(descriptors) >= DESCRIPTORS:
            # The caller may be compromised, and the system may have no room for a process.
            with suppress(OSError, ValueError, TypeError):
                self._start(json.loads(message), descriptors)
                return True
        for descriptor in descriptors:
            os.close(descriptor)
        if not message:
            self._poll.unregister(control.fileno())
            del self._controls[control.fileno()]
        return bool(message)

    def _start(self, order: dict[str, Any], descriptors: Sequence[int]) -> None:
        """Start a process; where this fails, no process has taken the descriptors."""
        input, request, answer, code, *more = descriptors
        id = os.fork()
        if id == 0:
            ended = FAILED
            # Even with an incomplete order, a new process never continues as a second launcher.
            try:
                ended = self._be(order, input, request, answer, *more)
            finally:
                os._exit(ended)
        for descriptor in (request, answer, *more):
            os.close(descriptor)
        self._processes[id] = _Process(id, input, code)
        # What is written into it is for the process; here only its end counts.
        self._poll.register(input, 0)

    def _be(
        self, order: dict[str, Any], input: int, request: int, answer: int, done: int = -1
    ) -> int:
        """Be the new process; return its exit code."""
        signal.set_wakeup_fd(-1)
        for number in (signal.SIGCHLD, signal.SIGALRM):
            signal.signal(number, signal.SIG_DFL)
        os.setpgid(0, 0)
        inner = self._inner_client.fileno() if order["works"] else -1
        _close_all_but({input, request, answer, inner, done})
        return run(order, self._sandbox, (input, request, answer, inner, done))

    def _reap(self) -> None:
        """Report how processes ended."""
        with suppress(BlockingIOError):
            os.read(self._woken, MESSAGE_LIMIT)
        for process in [*self._processes.values()]:
            code = _code_of(process.id)
            if code is not None:
                self._forget(process, code)
        self._orphans.end(self._processes)

    def _forget(self, process: _Process, code: int) -> None:
        del self._processes[process.id]
        _tell(process.code, code)
        with suppress(KeyError):
            self._poll.unregister(process.input)
        os.close(process.input)
        os.close(process.code)

    def _kill(self, input: int) -> None:
        """End the process whose input was closed."""
        with suppress(KeyError):  # it has ended by itself at the same moment
            self._poll.unregister(input)
        for process in self._processes.values():
            if process.input == input:
                _end(process.id)


def _end(process: int) -> None:
    """End a child, and all in its group at once: none of them can start one that survives."""
    for end in (os.killpg, os.kill):
        with suppress(OSError):
            end(process, signal.SIGKILL)


def _tell(pipe: int, code: int) -> None:
    """Write an exit code; the pipe of a compromised process may be full."""
    with suppress(OSError):
        signal.setitimer(signal.ITIMER_REAL, _TELL_SECONDS)
        try:
            os.write(pipe, str(code).encode())
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)


def _give_up(*_: object) -> None:
    raise TimeoutError


def _code_of(id: int) -> int | None:
    """Return the exit code of a process that has ended, and end what it has left in its group."""
    if hasattr(os, "waitid"):  # not on macOS before Python 3.13
        if os.waitid(os.P_PID, id, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
            return None
        # Until it is waited for, no other process can get the number of its group.
        with suppress(OSError):
            os.killpg(id, signal.SIGKILL)
    ended, status = os.waitpid(id, os.WNOHANG)
    return os.waitstatus_to_exitcode(status) if ended else None


def _close_all_but(kept: set[int]) -> None:
    """Close what the launcher has open, so that a process has only its own."""
    last = 2
    for descriptor in sorted(number for number in kept if number > last):
        os.closerange(last + 1, descriptor)
        last = descriptor
    os.closerange(last + 1, min(max(os.sysconf("SC_OPEN_MAX"), last + 1), _MOST_DESCRIPTORS))


def _limit_processes(layers: Sequence[Layer]) -> None:
    """Keep processes from starting too many, where only they count for their user."""
    held = {layer.name for layer in layers if layer.held}
    # A user namespace counts its own since Linux 5.14 (user_namespaces(7)); root has none here.
    version = tuple(int(part) for part in re.findall(r"\d+", os.uname().release)[:2])
    counts = NAMESPACES in held and os.getuid() != 0 and version >= _COUNTS_BY_NAMESPACE
    if ACCOUNT in held or counts:
        resource.setrlimit(resource.RLIMIT_NPROC, (_PROCESSES_LIMIT, _PROCESSES_LIMIT))


def main(descriptor: int, sandbox: str, niceness: int, loaded: str) -> None:
    """Serve on a socket that was inherited."""
    if niceness:
        lower_priority([os.getpid()], niceness)
    if loaded:
        load_prepared(loaded)
    with socket.socket(fileno=descriptor) as control:
        LauncherProcess(control, Sandbox(**json.loads(sandbox))).serve()


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3]), sys.argv[4])
    # What is still there ends with this process; no cleanup is needed.
    os._exit(0)
