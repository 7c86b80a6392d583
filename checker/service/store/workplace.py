"""Folders and files for work in progress, which go with the process that works in them.

Its owner holds a lock on a file: that of an upload itself, or one next to the folder. The system
drops the lock when the owner ends, however it ends: a process id would be given again, and means
nothing in another container.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import time

from checker.base.files import make_folder
from checker.service.store.locks import lock_of_dead, try_lock

# An upload while it comes in.


class TooLarge(Exception):
    """More bytes than an upload may have.

    Attributes:
        limit: Bytes that it may have.
    """

    def __init__(self, limit: int) -> None:
        super().__init__(f"the upload is larger than the {limit / 1e6:g} MB allowed")
        self.limit = limit


class Incoming:
    """Takes an upload piece by piece; used by one thread at a time.

    Attributes:
        path: The file of the bytes until then.
        size: Bytes so far.
    """

    def __init__(
        self, path: Path, descriptor: int, limit: int, admit: Callable[[Path, str], None]
    ) -> None:
        """Begin.

        Args:
            path: The path of an empty file.
            descriptor: The descriptor to write it; its owner closes it.
            limit: Bytes.
            admit: Takes the finished file and its hash.
        """
        from blake3 import blake3

        self.path, self.size, self._hash = path, 0, blake3()
        self._descriptor, self._limit, self._admit = descriptor, limit, admit

    def write(self, chunk: bytes) -> None:
        """Take the next bytes.

        Raises:
            TooLarge: There are more than allowed; the chunk is not written.
        """
        if self.size + len(chunk) > self._limit:
            raise TooLarge(self._limit)
        self.size += len(chunk)
        self._hash.update(chunk)
        left = memoryview(chunk)
        while left:  # a disk that is nearly full takes a part of it
            left = left[os.write(self._descriptor, left) :]

    def finish(self) -> str:
        """Put the upload into the store, and return its hash; see `Store.admit`.

        The hash is BLAKE3, 256 bits in hexadecimal: of a megabyte it takes 0.3 ms, where SHA-256
        takes 4.6 on processors without instructions for it.
        """
        hash = self._hash.hexdigest()
        self._admit(self.path, hash)
        return hash


# Moves of files and folders that a power failure does not undo or leave half done.


def settle(path: Path) -> None:
    """Write a file or folder to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def settle_below(folder: Path) -> None:
    """Write a folder to the disk with its content."""
    for place, _, names in os.walk(folder):
        for name in names:
            settle(Path(place, name))
        settle(Path(place))


def move(source: Path, target: Path) -> None:
    """Rename a file or folder on the disk to its final name; folders above are made as needed.

    A file of that name is replaced; a folder is not.

    Raises:
        OSError: A folder of that name contains files, or the names are on two file systems.
    """
    rename(source, target)
    settle_name(target)


def rename(source: Path, target: Path) -> None:
    """Do the same in no time; a power failure undoes it until `settle_name` has been called."""
    make_folder(target.parent)
    source.rename(target)


def settle_name(target: Path) -> None:
    """Write a name to the disk, and that of its folder, which may be new."""
    settle(target.parent)
    settle(target.parent.parent)


_LOCK, _FILE = ".lock", ".part"
_STRAY_SECONDS = 30.0


@contextmanager
def workplace(home: Path) -> Iterator[Path]:
    """Make an empty folder below `home`, and remove it at the end with all that it contains."""
    file, lock = _claimed(home, _LOCK)
    place = file.with_suffix("")
    try:
        place.mkdir(mode=0o700)
        yield place
    finally:
        _remove(file)
        os.close(lock)


@contextmanager
def work_file(home: Path) -> Iterator[tuple[Path, int]]:
    """Make an empty file below `home`, and remove it at the end unless it has been moved away.

    Yields:
        The file, and a descriptor to write it, which is closed at the end.
    """
    file, descriptor = _claimed(home, _FILE)
    try:
        yield file, descriptor
    finally:
        file.unlink(missing_ok=True)
        os.close(descriptor)


def _claimed(home: Path, suffix: str) -> tuple[Path, int]:
    """Return a new file and the descriptor that holds its lock."""
    home.mkdir(mode=0o700, parents=True, exist_ok=True)
    while True:
        file = home / (secrets.token_hex(16) + suffix)
        if (lock := try_lock(file, os.O_EXCL)) is not None:
            return file, lock


def sweep(home: Path) -> None:
    """Remove the work of owners that have ended without doing so, and files without an owner."""
    for stray in _strays(home):
        with suppress(OSError):
            _remove_all(stray)
            stray.unlink(missing_ok=True)
    for file in (*home.glob(f"*{_LOCK}"), *home.glob(f"*{_FILE}")):
        with suppress(OSError), lock_of_dead(file) as is_dead:
            if is_dead:
                _remove(file)


def _strays(home: Path) -> Iterator[Path]:
    """Yield what has no lock and is none: each folder of ours has one as long as it is there.

    Where a file system has no files without names, a temporary one has a name for a moment.
    """
    for place in home.glob("*"):
        with suppress(OSError):
            is_ours = place.suffix in (_LOCK, _FILE) or place.with_suffix(_LOCK).exists()
            if not is_ours and time() - place.lstat().st_mtime > _STRAY_SECONDS:
                yield place


def _remove(file: Path) -> None:
    """Remove a folder, then the file of its lock: what has no lock has no folder either."""
    place = file.with_suffix("")
    _remove_all(place)
    if not place.exists():
        file.unlink(missing_ok=True)


def _remove_all(place: Path) -> None:
    """Remove a folder, even if a compromised process has changed it.

    Folders in folders are moved to the top before they are removed: `rm` takes the longer for each,
    the deeper it is, so that a million of them would take days.
    """
    waiting = [place] if place.is_dir() else []
    while waiting:
        folder = waiting.pop()
        with suppress(OSError):
            folder.chmod(0o700)
            waiting += [_at_top(inner, place) for inner in _emptied(folder)]
            if folder != place:
                folder.rmdir()
    with suppress(OSError):
        place.rmdir()


def _emptied(folder: Path) -> Iterator[Path]:
    """Remove the files of a folder, and yield the folders in it."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir(follow_symlinks=False):
                yield Path(entry.path)
            else:
                Path(entry.path).unlink()


def _at_top(folder: Path, place: Path) -> Path:
    """Move a folder right below another one, if it is not there."""
    if folder.parent == place:
        return folder
    folder.chmod(0o700)  # else none but root may move it
    return folder.rename(place / secrets.token_hex(16))
