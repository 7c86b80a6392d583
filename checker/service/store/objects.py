"""Storage of uploads and results: the port, with a folder and S3 as implementations."""

from __future__ import annotations

import errno
from collections.abc import Collection
from enum import StrEnum
from pathlib import Path
from typing import Protocol


class Kind(StrEnum):
    """Kind of an object; it is under this name.

    Uploads are files as received; results and parts of checks are folders of files.
    """

    UPLOAD = "uploads"
    RESULT = "results"
    PARTS = "parts"


class StoreUnreachable(OSError):
    """The object store does not answer, or refuses."""

    def __init__(self, reason: str) -> None:
        super().__init__(errno.EIO, reason)


class Objects(Protocol):
    """Files and folders by kind and key, each there as a whole or not at all.

    A key has 64 hexadecimal digits, which callers check. Any number of processes use it at
    once. Each call raises OSError where the disk, the system or the object store fails.
    """

    def find(self, kind: Kind, key: str) -> Path | None:
        """Return where an object is on this machine, brought here if needed; None without."""

    def names(self, kind: Kind, key: str) -> tuple[str, ...]:
        """Return the names of a folder's files, such as `pkg/robot.glb`; none without it."""

    def use(self, kind: Kind, key: str) -> bool:
        """Return whether an object exists, and mark it as used now."""

    def put(self, kind: Kind, key: str, source: Path) -> None:
        """Keep a file or folder, which is gone after; of several folders of a key one is kept.

        Args:
            kind: What it is.
            key: The key of the object.
            source: A file on the file system of the store's folder.
        """

    def add(self, kind: Kind, key: str, source: Path) -> None:
        """Move the files of a folder into the folder of that key, one by one."""

    def expire(self, kind: Kind, before: float, still_used: Collection[str]) -> int:
        """Remove objects last used before a time, unless their key is in use; return how many."""

    def sweep(self) -> None:
        """Remove copies on this machine that were not used lately."""
