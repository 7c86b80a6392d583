"""How much work tests do, and how much the code does that they look at.

The code's is the same on a slow machine, and on one that others keep busy.

Work is the processor time of this process. Where that is too much, it is held against the time of a
task of a known size at the same moment.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

from hypothesis import settings

Case = TypeVar("Case")
THOROUGH = "thorough"
"""The profile of hypothesis that `make test-all` chooses."""
_TASK_SECONDS = 0.02
"""What the task takes on a machine of today that does nothing else."""


def is_thorough() -> bool:
    """Return whether these are the tests of `make test-all`, which have time for all cases."""
    return settings.get_current_profile_name() == THOROUGH


def examples(number: int) -> int:
    """Return how many examples a property gets: this number in `make test-all`, else a tenth."""
    return max(1, number * settings.default.max_examples // 100)


def large(number: int) -> int:
    """Return the size of a large input: this number in `make test-all`, else a quarter."""
    return number if is_thorough() else number // 4


def sampled(cases: Sequence[Case]) -> Sequence[Case]:
    """Return cases that are much alike: all of them in `make test-all`, else every fourth."""
    return cases if is_thorough() else cases[::4]


def seconds(work: Callable[[], object]) -> float:
    """Return the processor time of a piece of work, only to be compared with that of another.

    The garbage collector rests meanwhile: its pauses depend on everything that other tests left.
    """
    gc.disable()
    try:
        start = time.process_time()
        work()
        return time.process_time() - start
    finally:
        gc.enable()


def grows_linearly(short: Callable[[], object], long: Callable[[], object]) -> bool:
    """Return whether four times as much to do costs at most nine times the work.

    Linear growth gives 4, quadratic 16, which stays so however often it is tried. A constant is
    for clocks that tick coarsely; it shrinks with the inputs (`large`), so that it hides no square.
    """
    tick = 0.1 if is_thorough() else 0.025
    return any(seconds(long) < 9 * seconds(short) + tick for _ in range(3))


@contextmanager
def limited(most: float) -> Iterator[None]:
    """Assert that what is done inside is no more work than a machine of today does in a time.

    Args:
        most: That time, in seconds.
    """
    start = time.process_time()
    yield
    taken = time.process_time() - start
    allowed = most * (slowness() if taken > most else 1.0)
    assert taken <= allowed, f"{taken:.2f} s of work, {allowed:.2f} allowed"


def slowness() -> float:
    """Return how much longer work takes at the moment than on a machine of today: 1 or more."""
    start = time.process_time()
    words: dict[str, int] = {}
    for number in range(120_000):
        word = f"{number % 1000} "
        words[word] = words.get(word, 0) + len(word)
    return max(1.0, (time.process_time() - start) / _TASK_SECONDS)
