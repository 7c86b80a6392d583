"""What operating systems do differently: whether there are forks, files read at a place, limits."""

from __future__ import annotations

import mmap
import os
import select
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

FORKS: Final = hasattr(os, "fork")
"""Whether a process can fork; where none can (Windows), each piece of work is a new program."""


def read_at(descriptor: int, length: int, at: int) -> bytes:
    """Return what a file has at a place; its position may change."""
    if sys.platform != "win32" and hasattr(os, "pread"):
        return os.pread(descriptor, length, at)
    os.lseek(descriptor, at, os.SEEK_SET)
    return os.read(descriptor, length)


def tighten(name: str, soft: int, hard: int) -> None:
    """Set one limit of this process, `RLIMIT_…`; none that there is is raised.

    Nothing happens where the system has no such limit, as Windows, or refuses it, as macOS does
    with address space.
    """
    if sys.platform == "win32" or resource is None:
        return
    kind = getattr(resource, name)
    with suppress(*((ValueError,) if sys.platform == "darwin" else ())):
        resource.setrlimit(kind, tighter_limits(resource.getrlimit(kind), soft, hard))


def tighter_limits(limits: tuple[int, int], soft: int, hard: int) -> tuple[int, int]:
    """Return the soft and the hard limit to set where others are set already: the tighter of each.

    Args:
        limits: The soft and the hard limit that there are, as `resource.getrlimit` returns them.
        soft: The soft limit that is wanted.
        hard: The hard limit that is wanted, not below `soft`.
    """
    return tighter(limits[0], soft), tighter(limits[1], hard)


def tighter(limit: int, wanted: int) -> int:
    """Return what is wanted, or the limit that there is if it allows less."""
    return wanted if limit == unlimited() else min(limit, wanted)


def unlimited() -> int:
    """Return what stands for no limit; -1 where there are none at all."""
    if sys.platform == "win32" or resource is None:
        return -1
    return resource.RLIM_INFINITY


def limits_of(name: str) -> tuple[int, int]:
    """Return the soft and the hard limit `RLIMIT_…` of this process."""
    if sys.platform == "win32" or resource is None:
        return unlimited(), unlimited()
    return resource.getrlimit(getattr(resource, name))


def resident_bytes() -> int:
    """Return the bytes of memory that this process uses; the most so far on macOS, else 0."""
    try:
        pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    except OSError:
        if sys.platform == "win32" or resource is None:
            return 0
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # macOS counts in bytes
    return pages * mmap.PAGESIZE


def readable(descriptor: int, seconds: float) -> bool:
    """Wait until something can be read from a pipe, or its other end is closed.

    Args:
        descriptor: The pipe.
        seconds: The longest wait; what is negative counts as 0.
    """
    if sys.platform == "win32":
        raise OSError("Windows waits for sockets alone")
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    return bool(poll.poll(max(0.0, seconds) * 1000.0))
