"""Bounded reading of one file on disk: its bytes, or the reason why not."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import BinaryIO

from checker.base.record import Record


class NotReadable(Record):
    """A file that cannot be read, and why.

    Attributes:
        path: As it was asked for.
        reason: The end of a sentence that starts with the path.
    """

    path: str
    reason: str


def read_bytes(location: Path, path: str, limit: int) -> bytes | NotReadable:
    """Read a regular file of at most `limit` bytes.

    Args:
        location: Where it lies on disk, links resolved; a link put there since is refused.
        path: What to call it.
        limit: In bytes.
    """
    try:
        with open_file(location) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                return NotReadable(path, "is no regular file")
            if status.st_size > limit:
                return NotReadable(path, _too_large(status.st_size, limit))
            data = file.read(status.st_size + 1)
            if len(data) > status.st_size:
                # It grows while it is read.
                data += file.read(limit + 1 - len(data))
    except (OSError, ValueError) as error:
        return NotReadable(path, f"cannot be read: {getattr(error, 'strerror', None) or error}")
    return data if len(data) <= limit else NotReadable(path, _too_large(len(data), limit))


def open_file(location: Path) -> BinaryIO:
    """Open a file to be read; a link is refused, and a pipe keeps nobody waiting.

    Raises:
        OSError: It is a link, or cannot be opened.
        ValueError: No file has such a name.
    """
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    return open(os.open(location, flags | getattr(os, "O_BINARY", 0)), "rb")  # noqa: PTH123 - a descriptor, not a path


def _too_large(size: int, limit: int) -> str:
    return f"has {size / 1e6:.1f} MB, more than the {limit / 1e6:g} MB that are read"
