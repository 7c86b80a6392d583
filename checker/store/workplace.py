"""Folders for work in progress, which go with the process that works in them."""

from __future__ import annotations

import fcntl
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_LOCK = ".lock"


@contextmanager
def workplace(home: Path) -> Iterator[Path]:
    """Make an empty folder below `home`, and remove it at the end with all that it holds.

    Its owner holds a lock on the file beside it. The system drops the lock when the owner ends,
    however it ends: a process id would be given again, and means nothing in another container.
    """
    home.mkdir(mode=0o700, parents=True, exist_ok=True)
    place, lock = _claimed(home)
    try:
        place.mkdir(mode=0o700)
        yield place
    finally:
        _remove(place)
        os.close(lock)


def _claimed(home: Path) -> tuple[Path, int]:
    """Return a new place and the descriptor that holds its lock."""
    while True:
        place = home / secrets.token_hex(16)
        file = _lock_of(place)
        lock = os.open(file, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
        # Between these two lines the sweep may have taken it for one of the dead.
        if _locks(lock) and file.exists():
            return place, lock
        os.close(lock)


def sweep(home: Path) -> None:
    """Remove the folders whose owners have ended without doing so."""
    for file in home.glob(f"*{_LOCK}"):
        with suppress(OSError):
            lock = os.open(file, os.O_RDWR)
            try:
                if _locks(lock):
                    _remove(file.with_suffix(""))
            finally:
                os.close(lock)


def _locks(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _remove(place: Path) -> None:
    """Remove a folder, then the file of its lock: what has no lock has no folder either."""
    shutil.rmtree(place, ignore_errors=True)
    if not place.exists():
        _lock_of(place).unlink(missing_ok=True)


def _lock_of(place: Path) -> Path:
    return place.with_name(place.name + _LOCK)
