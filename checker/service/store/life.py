"""Files that processes lock as long as they live, so that others know at once that one has died.

The system drops a lock when its owner ends, however it ends. A process that hangs, or whose machine
is gone from the network, holds it still: that is what signs of life are for.
"""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import sleep

_LOOKS, _LOOK_SECONDS = 20, 0.05


@contextmanager
def living(folder: Path, name: str) -> Iterator[None]:
    """Hold the lock of a process; where another one of the same name holds it, nothing happens.

    Args:
        folder: Of all such files; made if it is missing.
        name: Of this process.

    Raises:
        OSError: The disk or the system fails.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    file = folder / name
    lock = os.open(file, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        ours = _locks_soon(lock)
        yield
        if ours:
            file.unlink(missing_ok=True)
    finally:
        os.close(lock)


def _locks_soon(descriptor: int) -> bool:
    """Lock a file, at which others may be looking just now."""
    for _ in range(_LOOKS):
        if _locks(descriptor):
            return True
        sleep(_LOOK_SECONDS)
    return False


def has_died(folder: Path, name: str) -> bool:
    """Whether a process has ended without saying so; False if nothing is known of it."""
    with suppress(OSError):
        lock = os.open(folder / name, os.O_RDWR)
        try:
            return _locks(lock)
        finally:
            os.close(lock)
    return False


def forget(folder: Path, name: str) -> None:
    """Remove the file of a process that has died."""
    with suppress(OSError):
        (folder / name).unlink()


def _locks(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
