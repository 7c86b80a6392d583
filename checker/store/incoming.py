"""An upload while it comes in."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path


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
        size: Bytes so far.
    """

    def __init__(self, file: Path, limit: int, admit: Callable[[Path, str], None]) -> None:
        """Begin.

        Args:
            file: Where the bytes go meanwhile; it is not there yet.
            limit: Bytes.
            admit: Takes the finished file and its hash.
        """
        self.size = 0
        self._path, self._limit, self._admit = file, limit, admit
        self._file = file.open("xb")
        self._digest = hashlib.sha256()

    def write(self, chunk: bytes) -> None:
        """Take the next bytes.

        Raises:
            TooLarge: There are more than allowed; the chunk is not written.
        """
        if self.size + len(chunk) > self._limit:
            raise TooLarge(self._limit)
        self.size += len(chunk)
        self._digest.update(chunk)
        self._file.write(chunk)

    def finish(self) -> str:
        """Put the upload into the store, safe from a power failure, and return its hash.

        Returns:
            SHA-256 of the content, hexadecimal.
        """
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()
        hash = self._digest.hexdigest()
        self._admit(self._path, hash)
        return hash

    def close(self) -> None:
        """Take no more; nothing happens after `finish`."""
        self._file.close()
