"""Files that processes lock while they run, so that others notice at once that one has ended.

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


def try_lock(file: Path, flags: int = 0) -> int | None:
    """Return the descriptor that holds the lock of a file, which is made if it is missing.

    Args:
        file: The file to lock.
        flags: The flags for opening it, such as `os.O_EXCL`.

    Returns:
        None if another process holds the lock, or has just removed the file.

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


@contextmanager
def hold_lock(folder: Path, name: str) -> Iterator[None]:
    """Hold the lock of a process; where another one of the same name holds it, nothing happens.

    Args:
        folder: The folder of all such files; made if it is missing.
        name: The name of this process.

    Raises:
        OSError: The disk or the system fails.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    lock = _locked_soon(folder / name)
    try:
        yield
        if lock is not None:
            (folder / name).unlink(missing_ok=True)
    finally:
        if lock is not None:
            os.close(lock)


def dead_processes(folder: Path) -> set[str]:
    """Return the names of processes that have ended without saying so."""
    with suppress(FileNotFoundError):
        return {path.name for path in folder.iterdir() if _is_free(path)}
    return set()


def forget(folder: Path, name: str) -> None:
    """Remove the file of a process that has died."""
    with suppress(OSError):
        (folder / name).unlink()


def _locked_soon(file: Path) -> int | None:
    """Return the descriptor that holds a lock, at which others may be looking just now."""
    for _ in range(_LOOKS):
        if (lock := try_lock(file)) is not None:
            return lock
        sleep(_LOOK_SECONDS)
    return None


def _is_free(file: Path) -> bool:
    with suppress(OSError), lock_of_dead(file) as is_dead:
        return is_dead
    return False
