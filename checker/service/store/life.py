"""Files that processes lock as long as they live, so that others know at once that one has died.

The system drops a lock when its owner ends, however it ends. A process that hangs, or whose machine
is gone from the network, holds it still: that is what signs of life are for.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import sleep

from checker.service.store.locks import claimed, lock_of_dead

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
    lock = _locked_soon(folder / name)
    try:
        yield
        if lock is not None:
            (folder / name).unlink(missing_ok=True)
    finally:
        if lock is not None:
            os.close(lock)


def the_dead(folder: Path) -> set[str]:
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
        if (lock := claimed(file)) is not None:
            return lock
        sleep(_LOOK_SECONDS)
    return None


def _is_free(file: Path) -> bool:
    with suppress(OSError), lock_of_dead(file) as is_dead:
        return is_dead
    return False
