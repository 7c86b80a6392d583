"""A message with files, in one file without a name that is handed from process to process.

The caller opens and copies files; the child opens none, and sees nothing else of the disk. An
answer is read likewise: nothing in it is a path that is followed, and its sizes are checked.

First come the contents of the files, then the message, then a table of the files as JSON, and last
the lengths of message and table, 8 bytes each.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, BinaryIO

from checker.base.files import NotReadable, read_bytes
from checker.base.system import read_at

FILES_LIMIT = 2_000_000_000
"""Bytes of all files of one message."""
TABLE_LIMIT = 20_000_000
"""Bytes of a table."""
_LENGTH = 8
_TAIL = 2 * _LENGTH
_PIECE = 1_000_000

Content = bytes | NotReadable


class Damaged(ValueError):
    """The input is not a message with files; the text ends a sentence."""


class Files:
    """Files that came with a message, by name."""

    def __init__(self, table: Mapping[str, Any], descriptor: int, start: int = 0) -> None:
        """Read nothing yet.

        Args:
            table: The offset and length of each file, by name, or why it could not be read.
            descriptor: The descriptor of the file with them; it stays open as long as this object
                is used.
            start: The offset from which the table counts.
        """
        self._table, self._descriptor, self._start = table, descriptor, start

    @property
    def names(self) -> tuple[str, ...]:
        """Their names, in the order in which they were written."""
        return tuple(self._table)

    def size(self, name: str) -> int:
        """Return the bytes of a file; 0 if it could not be read."""
        entry = self._table.get(name)
        return entry[1] if isinstance(entry, list) else 0

    def read(self, name: str) -> Content:
        """Return what is in a file, or why it is not known."""
        match self._table.get(name):
            case [int(at), int(length)]:
                return read_at(self._descriptor, length, self._start + at)
            case str(reason):
                return NotReadable(name, reason)
        return NotReadable(name, "was not passed to this process")

    def copy(self, name: str, to: BinaryIO) -> None:
        """Write what is in a file into another one; nothing if it could not be read."""
        match self._table.get(name):
            case [int(at), int(length)]:
                for begin in range(at, at + length, _PIECE):
                    piece = min(_PIECE, at + length - begin)
                    to.write(read_at(self._descriptor, piece, self._start + begin))


NO_FILES = Files({}, -1)


def write(file: BinaryIO, message: bytes, contents: Iterable[tuple[str, Content]] = ()) -> None:
    """Write a message and files.

    Args:
        file: Empty, or at its end.
        message: The message, of any form.
        contents: Names and what is in them; one at a time is held in memory.

    Raises:
        OSError: There is no room.
    """
    table: dict[str, Any] = {}
    at = 0
    for name, content in contents:
        if isinstance(content, bytes) and at + len(content) > FILES_LIMIT:
            content = NotReadable(name, "is too large together with the other files")  # noqa: PLW2901
        if isinstance(content, NotReadable):
            table[name] = content.reason
        else:
            table[name] = [at, len(content)]
            at += len(content)
            file.write(content)
    data = json.dumps(table).encode()
    file.write(message + data)
    file.write(len(message).to_bytes(_LENGTH, "big") + len(data).to_bytes(_LENGTH, "big"))
    file.flush()


def from_disk(wanted: Iterable[tuple[str, int]]) -> Iterable[tuple[str, Content]]:
    """Yield files by their absolute paths, links resolved.

    Args:
        wanted: Each path, and how many bytes there may be.
    """
    for path, limit in wanted:
        yield path, read_bytes(Path(path), path, limit)


def read(
    descriptor: int, limit: int, start: int = 0, end: int | None = None
) -> tuple[bytes, Files]:
    """Return the message and the files that another process has written.

    Args:
        descriptor: The descriptor of the file they are in; the writer may be hostile.
        limit: Bytes of the message.
        start: The offset at which they begin.
        end: The offset at which they end; None for the end of the file.

    Raises:
        Damaged: It is something else, or too long.
    """
    size = (os.fstat(descriptor).st_size if end is None else end) - start
    tail = read_at(descriptor, _TAIL, start + max(0, size - _TAIL))
    message, table = (int.from_bytes(field, "big") for field in (tail[:_LENGTH], tail[_LENGTH:]))
    at = size - _TAIL - table - message
    if len(tail) < _TAIL or at < 0:
        raise Damaged("is cut off")
    if message > limit or table > TABLE_LIMIT or at > FILES_LIMIT:
        raise Damaged(f"has {size / 1e6:.1f} MB, which is more than the limit")
    data = read_at(descriptor, message, start + at)
    entries = _checked(read_at(descriptor, table, start + at + message), at)
    return data, Files(entries, descriptor, start)


def _checked(data: bytes, end: int) -> dict[str, Any]:
    """Return a table whose files lie where they can."""
    try:
        table = json.loads(data)
    except (ValueError, RecursionError):
        raise Damaged("has no table of its files") from None
    if not isinstance(table, dict) or not all(_is_entry(entry, end) for entry in table.values()):
        raise Damaged("has no table of its files")
    return table


def _is_entry(entry: Any, end: int) -> bool:
    match entry:
        case [int(at), int(length)]:
            return at >= 0 and length >= 0 and at + length <= end
    return isinstance(entry, str)
