"""Measure the load of the machine: others may use the same processors.

The load of the host by others says nothing about the program: such a
figure is measured again. The speed of the processors differs too, by two from hour to hour, as
`pace` shows.
"""

from __future__ import annotations

import os
import statistics
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import TypeVar

T = TypeVar("T")
TRIES = 4
SHARE = 0.05
"""Share of the processors' time that others may take during a measurement."""


def undisturbed(measure: Callable[[], T]) -> T:
    """Measure until the host took no more than `SHARE`, at most four times; return the last."""
    for _ in range(TRIES):
        started, stolen = perf_counter(), _stolen()
        found = measure()
        share = (_stolen() - stolen) / (perf_counter() - started) / (os.cpu_count() or 1)
        if share <= SHARE:
            break
    return found


def pace() -> float:
    """Return how long a fixed piece of Python takes, milliseconds; the median of eleven."""
    return statistics.median(_piece() for _ in range(11)) * 1000


def _piece() -> float:
    started = perf_counter()
    total = 0
    for number in range(400_000):
        total += number * number
    return perf_counter() - started


def _stolen() -> float:
    """Return what the host has given to others, seconds of a processor (proc(5), `steal`)."""
    fields = Path("/proc/stat").read_text("ascii").split("\n", 1)[0].split()
    return int(fields[8]) / os.sysconf("SC_CLK_TCK")
