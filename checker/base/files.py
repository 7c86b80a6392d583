"""Bounded reading of one file on disk, and files and folders for their owner alone."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from checker.base.record import Record

# Files and folders for their owner alone, whatever umask a process is started with.


UMASK = 0o077
"""The umask of processes whose files no other user of the machine may read."""


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it that are missing, all for their owner alone.

    `Path.mkdir` would make those above it as the umask states.
    """
    if not folder.is_dir():
        make_folder(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)


def tighten_below(place: Path) -> None:
    """Take from all others what a file, or a folder and all that it contains, allows them."""
    tighten(place)
    for folder, folders, names in os.walk(place):
        for name in (*folders, *names):
            tighten(Path(folder, name))


def tighten(path: Path) -> None:
    """Take from all others what a file or folder allows them; a link stays what it is."""
    with suppress(OSError):  # it is gone by now, or belongs to another user
        mode = path.lstat().st_mode
        if mode & UMASK and not stat.S_ISLNK(mode):
            path.chmod(stat.S_IMODE(mode) & ~UMASK)


class NotReadable(Record):
    """A file that cannot be read, and why.

    Attributes:
        path: The requested path.
        reason: The end of a sentence that starts with the path.
    """

    path: str
    reason: str


class TooLarge(NotReadable):
    """A file that is larger than what is read: a limit of the checker, no fault of the file."""


def read_bytes(location: Path, path: str, limit: int) -> bytes | NotReadable:
    """Read a regular file of at most `limit` bytes.

    Args:
        location: Its place on disk, links resolved; a link put there since is refused.
        path: What to call it.
        limit: The greatest size, bytes.
    """
    try:
        with open_file(location) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                return NotReadable(path, "is not a regular file")
            if status.st_size > limit:
                return _too_large(path, status.st_size, limit)
            data = file.read(status.st_size + 1)
            if len(data) > status.st_size:
                # It grows while it is read.
                data += file.read(limit + 1 - len(data))
    except (OSError, ValueError) as error:
        return NotReadable(path, f"cannot be read: {getattr(error, 'strerror', None) or error}")
    return data if len(data) <= limit else _too_large(path, len(data), limit)


def open_file(location: Path) -> BinaryIO:
    """Open a file to be read; a link is refused, and a pipe does not block.

    Raises:
        OSError: It is a link, or cannot be opened.
        ValueError: No file has such a name.
    """
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    return open(os.open(location, flags | getattr(os, "O_BINARY", 0)), "rb")  # noqa: PTH123 - a descriptor, not a path


def _too_large(path: str, size: int, limit: int) -> TooLarge:
    reason = f"has {size / 1e6:.1f} MB, more than the limit of {limit / 1e6:g} MB"
    return TooLarge(path, reason)
