"""Work on hostile or heavy input in a child process with limits; it may die, its parent goes on.

The child runs one function of one module: `answer(request: bytes) -> bytes`. Requests and answers
are bytes (JSON, say), never pickles: a child that was taken over must not take its parent. They lie
in a folder of which the child is told when there is a request.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from time import monotonic

from checker.package.reading import NotReadable, read_bytes
from checker.record import record

_OWN_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_REQUEST, _ANSWER = "request", "answer"
"""Files in the folder of a child."""
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
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
            [*_COMMAND, module, str(int(limits.seconds)), str(limits.memory)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            # While it waits it has no folder, so that one that is killed leaves none.
            cwd="/",
            env=_environment(),
        )
        if request is not None:
            try:
                self.give(request)
            except BaseException:  # such as a full disk: nobody else knows of the process
                self.stop()
                raise

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether it has not ended."""
        return self._process.poll() is None

    def give(self, request: bytes) -> None:
        """Bring the request to a child that was started without one; its time begins now."""
        self.deadline = monotonic() + self.limits.clock_seconds
        # It works in a folder of its own: libraries write logs, and import what lies around.
        self._folder = tempfile.TemporaryDirectory(prefix="subt-check-", ignore_cleanup_errors=True)
        # In files, not through pipes: neither side waits for the other to read.
        for name, content in ((_REQUEST, request), (_ANSWER, b"")):
            Path(self._folder.name, name).write_bytes(content)
        # One that has died says why when it is asked for its answer.
        with suppress(OSError):
            if self._process.stdin is not None:
                self._process.stdin.write(os.fsencode(self._folder.name))
                self._process.stdin.close()

    def answer(self) -> bytes | Died:
        """Wait for the answer."""
        try:
            code = self._process.wait(max(self.deadline - monotonic(), 0.0))
            return self._answered() if code == 0 else Died(_cause(code, self.limits))
        except subprocess.TimeoutExpired:
            return Died(f"took longer than {self.limits.clock_seconds:g} s and was stopped")
        finally:
            self.stop()

    def _answered(self) -> bytes | Died:
        """Return what the child has left in its folder."""
        if self._folder is None:
            return Died("was given nothing")
        answer = read_bytes(Path(self._folder.name, _ANSWER), _ANSWER, ANSWER_LIMIT)
        if isinstance(answer, NotReadable):
            return Died(f"left an answer that {answer.reason}")
        # A library may end the process with exit code 0 before anything is said.
        return answer or Died("ended without an answer")

    def stop(self) -> None:
        """End the child, whatever it does; nothing happens if it has ended."""
        self._process.kill()
        self._process.wait()
        if self._process.stdin is not None:
            with suppress(OSError):
                self._process.stdin.close()
        if self._folder is not None:
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


def _work(module: str, seconds: int, memory: int) -> None:
    """Be the child: set the limits, then answer what lies in the folder that the parent names."""
    from importlib import import_module

    end_with_parent()
    _hold_to(seconds, memory)
    work = import_module(module)
    if hasattr(work, "prepare"):
        work.prepare()
    folder = sys.stdin.buffer.read()
    if folder:
        os.chdir(folder)
        Path(_ANSWER).write_bytes(work.answer(Path(_REQUEST).read_bytes()))


def _hold_to(seconds: int, memory: int) -> None:
    """Take from this process what it shall not use; no limit that it has already is raised."""
    import resource

    for kind, soft, hard in (
        (resource.RLIMIT_CPU, max(seconds, 1), max(seconds, 1) + 1),
        (resource.RLIMIT_AS, memory, memory),
        (resource.RLIMIT_CORE, 0, 0),
    ):
        resource.setrlimit(kind, tightened(resource.getrlimit(kind), soft, hard))


def tightened(given: tuple[int, int], soft: int, hard: int) -> tuple[int, int]:
    """Return the soft and the hard limit to set where others are set already: the tighter of each.

    Args:
        given: The soft and the hard limit that there are, as `resource.getrlimit` returns them.
        soft: The soft limit that is wanted.
        hard: The hard limit that is wanted, not below `soft`.
    """
    return tighter(given[0], soft), tighter(given[1], hard)


def tighter(limit: int, wanted: int) -> int:
    """Return what is wanted, or the limit that there is if it allows less."""
    from resource import RLIM_INFINITY

    return wanted if limit == RLIM_INFINITY else min(limit, wanted)


if __name__ == "__main__":
    code = 0
    try:
        _work(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
    except MemoryError:
        code = _OUT_OF_MEMORY
    except Exception:  # the parent says that the child failed
        code = _FAILED
        if os.environ.get("SUBT_CHECK_DEBUG"):
            raise
    os._exit(code)
