"""Starts processes that read untrusted files, from one clean process in the sandbox.

That one is started again, without the descriptors, variables and memory of its parent, and
enters its sandbox before it does anything else. A new process is a fork of it: two milliseconds,
against fifty for a new interpreter.
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from functools import cache as once
from functools import cached_property
from pathlib import Path
from typing import BinaryIO

from msgspec import to_builtins

from checker.base.errors import DEBUG
from checker.base.record import Record
from checker.base.sandbox import layers, namespaces
from checker.base.sandbox.account import free_account
from checker.base.sandbox.layers import Layer, Sandbox
from checker.base.sandbox.priority import lower_priority
from checker.base.sandbox.program_files import program_paths
from checker.base.sandbox.usage import Usage, descendant_ids, usage_below
from checker.base.system import readable

_CODE_LIMIT = 16
_HELLO_LIMIT = 10_000
_HELLO_SECONDS, _ENDS_SECONDS = 30.0, 10.0
_OF_WINDOWS = ("SYSTEMROOT", "TEMP") if sys.platform == "win32" else ()
"""Without these, Python does not start there, or has no folder for temporary files."""
_PASSED_ON = ("LANG", "LD_LIBRARY_PATH", "PATH", "TZ", DEBUG, *_OF_WINDOWS)
_DRAWING = ("EGL_", "GALLIUM_", "LIBGL_", "LP_", "MESA_", "__EGL_")
# What chooses the code that libraries of linear algebra run on this processor.
_NUMERIC = ("BLIS_", "MKL_", "NVPL_", "OMP_", "OPENBLAS_", "VECLIB_")
_FAMILIES = ("LC_", "PYTHON", *_DRAWING, *_NUMERIC)
_OWN_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


class Order(Record):
    """Request to start a process.

    Attributes:
        module: Its full name; see `checker.base.sandbox.task`.
        seconds: Seconds of processor time.
        memory: Bytes of address space.
        works: Whether it writes into the working folder, and requests processes itself.
        draws: Whether the process may use graphics cards.
        serves: Whether its request is a socket, by which it answers many (`serve` of its module).
        lasts: Whether it answers one request after the other (see `checker.base.child_server`).
    """

    module: str
    seconds: int
    memory: int
    works: bool = False
    draws: bool = False
    serves: bool = False
    lasts: bool = False


class Started(Record):
    """A process that was started.

    Attributes:
        input: Descriptor to write a byte into when its request is there; once it is closed, the
            process is killed.
        code: Descriptor from which its exit code comes, in decimal digits.
    """

    input: int
    code: int

    def begin(self, message: bytes) -> None:
        """Tell the process that its request is there."""
        # A dead process reports why when its answer is requested.
        with suppress(OSError):
            os.write(self.input, message)

    def wait(self, seconds: float) -> bytes | None:
        """Return its exit code in digits; None if it still runs after so many seconds."""
        return os.read(self.code, _CODE_LIMIT) if readable(self.code, seconds) else None

    def kill(self) -> None:
        """End it, whatever it does."""
        os.close(self.input)

    def close(self) -> None:
        """Let go of it once it has ended."""
        os.close(self.code)


class Launcher:
    """Starts processes by a socket to the launcher process."""

    def __init__(self, control: socket.socket) -> None:
        """Take the socket."""
        self._control = control
        self._lock = threading.Lock()

    def start(self, order: Order, request: BinaryIO, answer: BinaryIO, *more: int) -> Started:
        """Start a process; it waits for its request.

        Args:
            order: What it does.
            request: The file that its request will be written into.
            answer: The file that it writes its answer into.
            more: The descriptor by which it states that an answer is there, if it lasts.

        Raises:
            OSError: No launcher runs.
        """
        if sys.platform == "win32":
            raise OSError("Windows hands no descriptors on: PlainLauncher starts processes there")
        input, ours = os.pipe()
        code, theirs = os.pipe()
        handed = (input, request.fileno(), answer.fileno(), theirs, *more)
        try:
            with self._lock:
                message = json.dumps(to_builtins(order)).encode()
                socket.send_fds(self._control, [message], handed)
        except OSError:
            os.close(ours)
            os.close(code)
            raise
        finally:
            os.close(input)
            os.close(theirs)
        return Started(ours, code)

    def close(self) -> None:
        """End all that was started, soon."""
        self._control.close()


class OwnLauncher(Launcher):
    """A launcher with its own process, which ends with this one."""

    def __init__(
        self,
        work: Path | None = None,
        names: Sequence[str] = layers.ALL,
        niceness: int = 0,
        loaded: str = "",
    ) -> None:
        """Start the process; it enters its sandbox while the caller continues.

        Args:
            work: Folder that a process may write in; where this process is root's, it becomes that
                of the account that its processes get.
            names: Layers, of `layers.ALL`; others than all are for tests of each alone.
            niceness: The value for `nice` that gives its processes a lower priority.
            loaded: Module that all of its processes need; it is loaded and prepared once for all.
        """
        wrapped = self._wrapped = layers.NAMESPACES in names and not namespaces.bubblewrap()
        sandbox = Sandbox(
            tuple(names),
            wrapped,
            free_account(),
            "" if work is None else namespaces.WORK if wrapped else str(work),
            tuple(program_paths()),
        )
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
                _command(sandbox, (str(niceness), loaded), theirs.fileno(), work),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=None if os.environ.get(DEBUG) else subprocess.DEVNULL,
                pass_fds=(theirs.fileno(),),
                cwd="/",
                env=environment(sandbox.work),
                # A key that interrupts this program does not interrupt its processes before it.
                start_new_session=True,
            )
        super().__init__(ours)

    @property
    def alive(self) -> bool:
        """True if its process has not ended."""
        return self._process.poll() is None

    @cached_property
    def layers(self) -> tuple[Layer, ...]:
        """Active layers; the first call waits for them. None if its process has ended."""
        data = b""
        self._control.settimeout(_HELLO_SECONDS)
        try:
            while not data.endswith(b"\n"):
                piece = self._control.recv(_HELLO_LIMIT)
                if not piece:
                    return ()
                data += piece
        except TimeoutError:
            return ()
        finally:
            self._control.settimeout(None)
        return tuple(Layer(*load) for load in json.loads(data))

    def usage(self, folder: Path, most: Usage) -> Usage:
        """Return what all that was started uses together; see `usage_below`."""
        return usage_below(self._process.pid, folder, most)

    def lower_priority(self, by: int) -> None:
        """Lower the priority of all started processes, in steps of `nice`."""
        if processes := descendant_ids(self._process.pid):
            lower_priority(processes, by)

    def close(self) -> None:
        """End all that was started, and wait until it has ended."""
        super().close()
        if self._wrapped:
            namespaces.end(self._process.pid)
        try:
            self._process.wait(_ENDS_SECONDS)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def launcher() -> Launcher:
    """Return what starts processes for this one; without any, it is started now."""
    with _LOCK:
        launchers = _launchers(os.getpid())
        if launchers and isinstance(launchers[0], OwnLauncher) and not launchers[0].alive:
            launchers.clear()
        if not launchers:
            launchers.append(OwnLauncher())
        return launchers[0]


def inherit(descriptor: int) -> None:
    """Start the processes of this one by the launcher that started it.

    Args:
        descriptor: The descriptor of a socket to it.
    """
    _launchers(os.getpid()).append(Launcher(socket.socket(fileno=descriptor)))


_LOCK = threading.Lock()


@once
def _launchers(_: int) -> list[Launcher]:
    """Return a list of the launcher of this process, empty at first; a fork has its own."""
    return []


def _command(
    sandbox: Sandbox, paths: tuple[str, str], control: int, work: Path | None
) -> list[str]:
    # `-P` keeps the folder that it runs in out of the search for modules.
    module = f"{__package__}.launcher_process"
    arguments = (str(control), json.dumps(to_builtins(sandbox)), *paths)
    own = [sys.executable, "-P", "-m", module, *arguments]
    folder = "" if work is None else str(work)
    return namespaces.sandboxed_command(own, sandbox.read, folder) if sandbox.wrapped else own


def module_path() -> str:
    """Return the `PYTHONPATH` by which a process finds the same modules, wherever it runs."""
    here = str(Path(__file__).parents[3])
    others = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    # What is relative would mean another folder there.
    return os.pathsep.join((here, *filter(os.path.isabs, others)))


def environment(work: str) -> dict[str, str]:
    """Return the part of our environment that a process gets: no token, no password, no home."""
    known = {
        name: value
        for name, value in os.environ.items()
        if name in _PASSED_ON or name.startswith(_FAMILIES)
    }
    # Processes that draw set this; for all others MuJoCo would look for windows when it is loaded.
    own = {"HOME": work or "/", "PYTHONPATH": module_path(), "MUJOCO_GL": "disable"}
    return known | own | dict.fromkeys(_OWN_THREADS, "1")
