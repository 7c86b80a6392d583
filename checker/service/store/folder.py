"""Objects in a folder: of one machine, or shared by several over a network file system.

An upload is the file `uploads/ab/<hash>`. A result is the folder `results/ab/<key>`; its key
depends on everything that the report depends on. Parts that checks of an upload have computed
(`checker.base.cache`) are in the folder `parts/ab/<hash>`.
"""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from checker.base.files import make_folder
from checker.base.record import Record
from checker.service.store.objects import Kind
from checker.service.store.workplace import (
    move,
    rename,
    settle,
    settle_below,
    settle_name,
    workplace,
)


class FolderObjects(Record):
    """Objects in a folder; see `Objects`.

    Attributes:
        folder: The folder of the store; created on the first write.
    """

    folder: Path

    def find(self, kind: Kind, key: str) -> Path | None:
        """Return the path of an object; None if there is none."""
        place = self._place(kind, key)
        return place if place.exists() else None

    def names(self, kind: Kind, key: str) -> tuple[str, ...]:
        """Return the names of a folder's files; none without it."""
        place = self._place(kind, key)
        if not place.exists():
            return ()
        with self._alone():  # a folder that expires loses its files one by one
            return tuple(
                path.relative_to(place).as_posix() for path in place.rglob("*") if path.is_file()
            )

    def use(self, kind: Kind, key: str) -> bool:
        """Return whether an object exists, and mark it as used now."""
        place = self._place(kind, key)
        if not place.exists():  # most are new: no request waits for these
            return False
        with self._alone():
            return _touched(place)

    def put(self, kind: Kind, key: str, source: Path) -> None:
        """Move a file or folder into place, safe from a power failure; the first folder wins."""
        place = self._place(kind, key)
        if source.is_dir():
            settle_below(source)
            with self._alone():
                if not _touched(place):
                    move(source, place)
            shutil.rmtree(source, ignore_errors=True)
            return
        settle(source)
        with self._alone():
            rename(source, place)
        settle_name(place)

    def add(self, kind: Kind, key: str, source: Path) -> None:
        """Move the files of a folder into the folder of that key, one by one."""
        place = self._place(kind, key)
        for path in source.rglob("*"):
            if path.is_file():
                target = place / path.relative_to(source)
                make_folder(target.parent)
                path.replace(target)

    def expire(self, kind: Kind, before: float, still_used: Collection[str]) -> int:
        """Remove objects that were last used before a time, unless their key is still used.

        Returns:
            How many went.
        """
        with workplace(self.folder / "incoming") as bin:
            return sum(
                self._expire_one(path, before, bin)
                for path in (self.folder / kind).glob("[0-9a-f][0-9a-f]/*")
                if path.name not in still_used
            )

    def sweep(self) -> None:
        """Do nothing: there are no copies."""

    def _expire_one(self, path: Path, before: float, bin: Path) -> bool:
        with self._alone(), suppress(FileNotFoundError):
            if path.stat().st_mtime < before:
                # A folder goes at once; its files go when the workplace does.
                path.rename(bin / path.name)
                return True
        return False

    def _place(self, kind: Kind, key: str) -> Path:
        return self.folder / kind / key[:2] / key

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Keep others from removing what is just being used again, for a moment."""
        make_folder(self.folder)
        lock = os.open(self.folder / "lock", os.O_RDWR | os.O_CREAT, 0o600)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield
        finally:
            os.close(lock)


def _touched(place: Path) -> bool:
    try:
        os.utime(place)
    except FileNotFoundError:
        return False
    return True
