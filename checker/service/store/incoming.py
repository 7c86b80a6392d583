"""An upload while it comes in."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

_PIECE = 262_144
"""Bytes that are read at a time."""


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
        path: Where the bytes lie meanwhile.
        size: Bytes so far.
    """

    def __init__(
        self, path: Path, descriptor: int, limit: int, admit: Callable[[Path, str], None]
    ) -> None:
        """Begin.

        Args:
            path: Of an empty file.
            descriptor: To write it; its owner closes it.
            limit: Bytes.
            admit: Takes the finished file and its hash.
        """
        self.path, self.size = path, 0
        self._descriptor, self._limit, self._admit = descriptor, limit, admit

    def write(self, chunk: bytes) -> None:
        """Take the next bytes.

        Raises:
            TooLarge: There are more than allowed; the chunk is not written.
        """
        if self.size + len(chunk) > self._limit:
            raise TooLarge(self._limit)
        self.size += len(chunk)
        left = memoryview(chunk)
        while left:  # a disk that is nearly full takes a part of it
            left = left[os.write(self._descriptor, left) :]

    def finish(self) -> str:
        """Put the upload into the store, and return its hash; see `Store.admit`."""
        hash = content_hash(self.path)
        self._admit(self.path, hash)
        return hash


def content_hash(file: Path) -> str:
    """Return the BLAKE3 of a file's content: 256 bits, hexadecimal.

    Each upload waits for it: 0.3 ms for a megabyte, and SHA-256 takes 4.6 where processors have no
    instructions for it.
    """
    from blake3 import blake3

    digest = blake3()
    with file.open("rb", buffering=0) as opened:
        while piece := opened.read(_PIECE):
            digest.update(piece)
    return digest.hexdigest()
