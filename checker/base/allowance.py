"""Limits of processor time and memory for one piece of work within this process.

Child processes have their own limits (`checker.base.child_process`). This process cannot be ended
for one piece, so that a timer interrupts the piece and the work after it continues.
"""

from __future__ import annotations

import gc
import math
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from time import process_time

from checker.base.system import limits_of, resident_bytes, unlimited

SECONDS = 60.0
"""Limit for one piece, in processor time; rules take 0.01 s, and reading a robot 1 s."""
SECONDS_FOR_ALL = 180.0
"""Limit for all pieces of one package."""
MEMORY = 1_000_000_000
"""Bytes by which one piece may make the process grow; all together, by twice as many."""
_RESERVE = 60.0
"""Seconds below a limit of the process itself: for the report, after all pieces have ended."""
_INTERVAL = 0.05
"""Seconds of processor time between two looks."""


class Exceeded(BaseException):
    """A piece of work needs more than it may use.

    Not an `Exception`: code that continues after any other error must not continue after this one.

    Attributes:
        reason: The end of a sentence whose subject is the work.
    """

    def __init__(self, reason: str) -> None:
        """Make it."""
        super().__init__(reason)
        self.reason = reason


class Allowance:
    """Limits for the pieces of work of one package, each of them and together."""

    def __init__(
        self,
        seconds: float = SECONDS,
        seconds_for_all: float = SECONDS_FOR_ALL,
        memory: int = MEMORY,
    ) -> None:
        """Begin with nothing used.

        Args:
            seconds: Seconds of processor time, for each piece.
            seconds_for_all: Seconds of processor time for all together.
            memory: Bytes by which a piece may make the process grow.
        """
        self._seconds, self._left, self._memory = seconds, seconds_for_all, memory
        self._spent = f"the package takes more than {seconds_for_all:g} s of processor time"
        self._most = resident_bytes() + 2 * memory
        self._interrupted = False

    @contextmanager
    def piece(self) -> Iterator[None]:
        """Interrupt what is done inside when it has used too much.

        A piece within a piece is part of it. Python interrupts its main thread alone: in others,
        nothing is, and neither on Windows, which has no timer for it.

        Raises:
            Exceeded: It was interrupted, there is no memory left, or the pieces before have used
                up what there is for all.
        """
        in_main_thread = threading.current_thread() is threading.main_thread()
        if (
            sys.platform == "win32"
            or not hasattr(signal, "setitimer")
            or not in_main_thread
            or isinstance(signal.getsignal(signal.SIGPROF), _Watch)
        ):
            yield
            return
        watch = self._next()
        try:
            yield from _watched(watch)
        except Exceeded:
            self._interrupted = True
            raise
        finally:
            self._left -= watch.spent

    def _next(self) -> _Watch:
        """Return what watches the next piece."""
        if self._interrupted:
            # What was half made holds itself, while collection is put off.
            gc.collect()
            self._interrupted = False
        left, resident = min(self._left, _left_of_process()), resident_bytes()
        if left <= 0.0:
            raise Exceeded(f"was not begun: {self._spent}")
        if resident >= self._most:
            raise Exceeded(f"was not begun: the package {_too_large(2 * self._memory)}")
        is_last = left < self._seconds
        words = self._spent if is_last else f"needs more than {self._seconds:g} s of processor time"
        room = min(self._memory, self._most - resident)
        return _Watch(min(left, self._seconds), words, resident + room, _too_large(self._memory))


def _watched(watch: _Watch) -> Iterator[None]:
    if sys.platform == "win32":
        raise OSError("Windows has no timers of processor time")
    before = signal.signal(signal.SIGPROF, watch)
    signal.siginterrupt(signal.SIGPROF, False)
    signal.setitimer(signal.ITIMER_PROF, _INTERVAL, _INTERVAL)
    out_of_memory = False
    try:
        yield
    except MemoryError:
        out_of_memory = True
    finally:
        watch.is_over = True
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    if out_of_memory:  # said here, where what the error held has been let go
        raise Exceeded("needs more memory than there is")


class _Watch:
    """Checks the use of a piece of work now and then: the handler of the timer's signal."""

    def __init__(self, seconds: float, too_long: str, most: int, too_large: str) -> None:
        """Begin to count.

        Args:
            seconds: Seconds of processor time that the piece may take.
            too_long: What is stated about one that takes longer.
            most: Bytes that the process may have meanwhile.
            too_large: What is stated about a piece that makes it larger.
        """
        self._begun, self._seconds, self._too_long = process_time(), seconds, too_long
        self._most, self._too_large = most, too_large
        self.is_over = False

    @property
    def spent(self) -> float:
        """Seconds of processor time so far."""
        return process_time() - self._begun

    def __call__(self, _number: int, _frame: object) -> None:
        """Interrupt a piece that has used too much; again, where one has swallowed that."""
        if self.is_over:
            return
        if self.spent > self._seconds:
            raise Exceeded(self._too_long)
        if resident_bytes() > self._most:
            raise Exceeded(self._too_large)


def _too_large(memory: int) -> str:
    return f"needs more than {memory / 1e9:g} GB of memory"


def _left_of_process() -> float:
    """Return the seconds of processor time that are left of those that the process has, if any."""
    soft, _ = limits_of("RLIMIT_CPU")
    return math.inf if soft == unlimited() else soft - _RESERVE - process_time()
