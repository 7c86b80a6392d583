"""Locks on files, which the system drops when their owner ends, however it ends."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def claimed(file: Path, flags: int = 0) -> int | None:
    """Return the descriptor that holds the lock of a file, which is made if it is missing.

    Args:
        file: To lock.
        flags: For opening it, such as `os.O_EXCL`.

    Returns:
        None if somebody else holds the lock, or has just removed the file.

    Raises:
        OSError: The disk or the system fails.
    """
    lock = os.open(file, os.O_RDWR | os.O_CREAT | flags, 0o600)
    # Between these two lines it may have been taken for one of the dead, and removed.
    if _locks(lock) and os.fstat(lock).st_nlink:
        return lock
    os.close(lock)
    return None


@contextmanager
def lock_of_dead(file: Path) -> Iterator[bool]:
    """Hold the lock of a file whose owner has ended; False if it lives.

    Raises:
        OSError: There is no such file, or it cannot be opened.
    """
    lock = os.open(file, os.O_RDWR)
    try:
        yield _locks(lock)
    finally:
        os.close(lock)


def _locks(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
