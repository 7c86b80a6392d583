"""Work on hostile or heavy input in a child process with limits; it may die, its parent goes on.

The child runs one function of one module: `answer(request: bytes) -> bytes`. Requests and answers
are bytes (JSON, say), never pickles: a child that was taken over must not take its parent.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from time import monotonic

from checker.record import record

_OWN_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
ANSWER_LIMIT = 200_000_000
"""Bytes; an answer has at least one."""
_STARTUP_SECONDS = 10.0
"""For the interpreter and its imports, on a machine that does something else as well."""


@record()
class Limits:
    """What a child may use.

    Attributes:
        seconds: Of processor time; four times as many pass on the clock before it is stopped.
        memory: Bytes of address space.
    """

    seconds: float
    memory: int = 1_000_000_000

    @property
    def clock_seconds(self) -> float:
        """How long the child may take by the clock."""
        return 4.0 * self.seconds + _STARTUP_SECONDS


@record()
class Died:
    """No answer came.

    Attributes:
        reason: Why, as the end of a sentence whose subject is the work.
    """

    reason: str


class Child:
    """A child process that works while its parent does something else."""

    def __init__(self, module: str, request: bytes | None, limits: Limits) -> None:
        """Start it.

        Args:
            module: Full name of the module whose `answer` does the work. Its `prepare`, if it has
                one, is called before the request is there.
            request: What `answer` is given; None when `give` brings it later.
            limits: What the child may use.
        """
        self.limits = limits
        self.deadline = monotonic() + limits.clock_seconds
        # It lives in a folder of its own: libraries write logs, and import what lies around.
        self._folder = tempfile.TemporaryDirectory(prefix="subt-check-", ignore_cleanup_errors=True)
        self._answer = Path(self._folder.name) / "answer"
        request_file = Path(self._folder.name) / "request"
        request_file.write_bytes(request or b"")
        # Files, not pipes: neither side waits for the other to read.
        with request_file.open("rb") as given, self._answer.open("wb") as taken:
            self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
                [*_COMMAND, module, str(int(limits.seconds)), str(limits.memory)],
                stdin=subprocess.PIPE if request is None else given,
                stdout=taken,
                stderr=subprocess.DEVNULL,
                cwd=self._folder.name,
                env=_environment(),
            )

    def give(self, request: bytes) -> None:
        """Bring the request to a child that was started without one; its time begins now."""
        self.deadline = monotonic() + self.limits.clock_seconds
        # One that has died says why when it is asked for its answer.
        with suppress(OSError):
            if self._process.stdin is not None:
                self._process.stdin.write(request)
                self._process.stdin.close()

    def answer(self) -> bytes | Died:
        """Wait for the answer."""
        try:
            code = self._process.wait(max(self.deadline - monotonic(), 0.0))
            if code != 0:
                return Died(_cause(code, self.limits))
            with self._answer.open("rb") as file:
                answer = file.read(ANSWER_LIMIT + 1)
            if len(answer) > ANSWER_LIMIT:
                return Died(f"answered with more than {ANSWER_LIMIT / 1e6:.0f} MB")
            # A library may end the process with exit code 0 before anything is said.
            return answer or Died("ended without an answer")
        except subprocess.TimeoutExpired:
            return Died(f"took longer than {self.limits.clock_seconds:g} s and was stopped")
        finally:
            self.stop()

    def stop(self) -> None:
        """End the child, whatever it does; nothing happens if it has ended."""
        self._process.kill()
        self._process.wait()
        if self._process.stdin is not None:
            with suppress(OSError):
                self._process.stdin.close()
        self._folder.cleanup()


# `-P` keeps the folder that it runs in out of the search for modules.
_COMMAND = (sys.executable, "-P", "-m", "checker.confined")


def module_path() -> str:
    """Return the `PYTHONPATH` by which a child finds the same modules, wherever it runs."""
    here = str(Path(__file__).parent.parent)
    return os.pathsep.join(filter(None, (here, os.environ.get("PYTHONPATH"))))


def _environment() -> dict[str, str]:
    # Nothing is drawn here, and MuJoCo refuses to load where its renderer does not.
    own = {name: value for name, value in os.environ.items() if name != "MUJOCO_GL"}
    return {**own, **dict.fromkeys(_OWN_THREADS, "1"), "PYTHONPATH": module_path()}


def ask(module: str, request: bytes, limits: Limits) -> bytes | Died:
    """Let a child do the work of a module and wait for the answer; see `Child`."""
    return Child(module, request, limits).answer()


_OUT_OF_MEMORY, _FAILED = 71, 70
"""Exit codes of a child, as in sysexits.h: EX_OSERR, EX_SOFTWARE."""


def _cause(code: int, limits: Limits) -> str:
    import signal

    if code == _OUT_OF_MEMORY:
        return f"needs more than {limits.memory / 1e6:.0f} MB of memory"
    if code == -signal.SIGXCPU:
        return f"needs more than {limits.seconds:g} s of processor time"
    if code == -signal.SIGKILL:
        return "was killed: it needs too much time or memory"
    if code < 0:
        return f"ended in a crash (signal {signal.Signals(-code).name})"
    return "failed in its process"


def end_with_parent() -> None:
    """Have this process killed when its parent ends, where the system can (Linux: prctl)."""
    import ctypes
    import signal

    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


_PR_SET_PDEATHSIG = 1


def _work(module: str, seconds: int, memory: int) -> int:
    """Be the child: set the limits, then answer what stands on the standard input."""
    import resource
    from importlib import import_module

    end_with_parent()
    resource.setrlimit(resource.RLIMIT_CPU, (max(seconds, 1), max(seconds, 1) + 1))
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    # Whatever a library prints must not stand in the answer.
    answer_to = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    try:
        work = import_module(module)
        if hasattr(work, "prepare"):
            work.prepare()
        answer = work.answer(sys.stdin.buffer.read())
        answer_to.write(answer)
        answer_to.close()
    except MemoryError:
        return _OUT_OF_MEMORY
    return 0


if __name__ == "__main__":
    try:
        code = _work(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
    except Exception:  # the parent says that the child failed
        code = _FAILED
        if os.environ.get("SUBT_CHECK_DEBUG"):
            raise
    os._exit(code)
