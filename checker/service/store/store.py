"""Uploads and results by hash and key: whole or not at all, even if a process ends meanwhile.

Work in progress is in the folder `incoming/` of this machine; finished objects are behind a port
(`checker.service.store.objects`). Many processes use it at once, on any number of machines.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from checker.base.files import make_folder, tighten, tighten_below
from checker.base.record import Record
from checker.report.files import ARTEFACT_NAME
from checker.service.store.folder import FolderObjects
from checker.service.store.objects import Kind, Objects
from checker.service.store.packed import pack
from checker.service.store.place import DATABASE, data_folder
from checker.service.store.workplace import Incoming, TooLarge, sweep, work_file, workplace

__all__ = ["DEFAULT_UPLOAD_LIMIT", "SUMMARY", "Incoming", "Store", "TooLarge", "open_store"]

DEFAULT_UPLOAD_LIMIT = 100_000_000
"""Bytes."""
SUMMARY = "summary.json"
"""In each result, for the engine alone: what the state of a check states about its packages."""
RESULT_LIMIT = 1_000_000_000
"""Bytes of one result."""
CACHE_SECONDS = 86_400.0
"""Time that parts of a check are kept after their last use: for its second stage, and for the same
upload with another profile."""
_OURS = ("uploads", "results", "incoming", "parts", "workers", "cache", "lock")
_KEY = re.compile(r"[0-9a-f]{64}")


class Store(Record):
    """Store of uploads and their results.

    Attributes:
        folder: The folder of work in progress on this machine, and of all that is kept unless
            `shared` keeps it; made when it is first needed.
        shared: Keeps uploads and results for several machines.
    """

    folder: Path
    shared: Objects | None = None

    @property
    def objects(self) -> Objects:
        """Storage of uploads and results."""
        return self.shared or FolderObjects(self.folder)

    @contextmanager
    def incoming(self, limit: int = DEFAULT_UPLOAD_LIMIT) -> Iterator[Incoming]:
        """Take an upload of at most `limit` bytes; without its `finish`, nothing of it is left."""
        make_folder(self.folder)
        with work_file(self.folder / "incoming") as (path, descriptor):
            yield Incoming(path, descriptor, limit, self.admit)

    def admit(self, file: Path, hash: str) -> None:
        """Keep an upload that has come whole, safe from a power failure.

        Args:
            file: The file of `Incoming`; it is gone after.
            hash: The hash of its content, as `Incoming.finish` states it.
        """
        self.objects.put(Kind.UPLOAD, hash, file)

    @contextmanager
    def workplace(self) -> Iterator[Path]:
        """Make a folder for work in progress; removed at the end, or by `sweep`."""
        make_folder(self.folder)
        with workplace(self.folder / "incoming") as place:
            yield place

    def parts(self, hash: str) -> Path | None:
        """Return the folder of what checks of an upload have computed; None if there is none."""
        return self._find(Kind.PARTS, hash)

    def add_parts(self, hash: str, folder: Path) -> None:
        """Keep what a check of an upload has computed, for others of the same."""
        self.objects.add(Kind.PARTS, hash, folder)

    def upload(self, hash: str) -> Path | None:
        """Return the file of an upload; None if it is not there."""
        return self._find(Kind.UPLOAD, hash)

    def has(self, key: str) -> bool:
        """Return whether a result exists, and mark it as used now, so that it is kept longer."""
        return _KEY.fullmatch(key) is not None and self.objects.use(Kind.RESULT, key)

    def keep(self, key: str, folder: Path) -> None:
        """Keep a finished folder of artefacts; the first one of a key wins.

        Args:
            key: The key of the result, 64 hexadecimal digits.
            folder: A folder on the file system of the store, such as in a `workplace`; it is gone
                after.

        Raises:
            ValueError: The key is none, or the folder contains what no result does.
        """
        if not _KEY.fullmatch(key):
            raise ValueError(f"{key!r} is not the key of a result")
        _check_result(folder)
        pack(folder)
        self.objects.put(Kind.RESULT, key, folder)

    def file(self, key: str, name: str) -> Path | None:
        """Return a file of a result by its name, such as `pkg/robot.glb`; None if there is none."""
        place = self._find(Kind.RESULT, key) if _is_of_result(name) else None
        if place is None:
            return None
        path = place / name
        try:
            return path if path.is_file() else None
        except OSError:  # no file system has names as long
            return None

    def names(self, key: str) -> tuple[str, ...]:
        """Return the names of a result's files that are for people and programs, sorted."""
        names = self.objects.names(Kind.RESULT, key) if _KEY.fullmatch(key) else ()
        return tuple(sorted(name for name in names if ARTEFACT_NAME.fullmatch(name)))

    def expire(self, before: float, still_used: Collection[str]) -> Mapping[Kind, int]:
        """Remove files that were not used again.

        Args:
            before: Seconds since the epoch; what was used later stays.
            still_used: Hashes and keys that stay whatever their age.

        Returns:
            How many of each kind went.
        """
        used = (Kind.UPLOAD, Kind.RESULT)
        gone = {kind: self.objects.expire(kind, before, still_used) for kind in used}
        gone[Kind.PARTS] = self.objects.expire(Kind.PARTS, before - CACHE_SECONDS, ())
        # 0.1.0 shared what it had computed between uploads.
        with self.workplace() as place, suppress(FileNotFoundError):
            (self.folder / "cache").rename(place / "cache")
        return gone

    @property
    def workers(self) -> Path:
        """The folder of `checker.service.store.locks`."""
        return self.folder / "workers"

    def sweep(self) -> None:
        """Remove the temporary files of processes that have died, and spare copies."""
        sweep(self.folder / "incoming")
        self.objects.sweep()

    def tighten(self) -> None:
        """Take from other users what an older version, or a copy, has left them of all this.

        What else is in the folder is not ours; then the folder itself stays as it is.
        """
        for name in _OURS:
            tighten_below(self.folder / name)
        with suppress(FileNotFoundError):
            names = [path.name for path in self.folder.iterdir()]
            if all(name in _OURS or name.startswith(DATABASE) for name in names):
                tighten(self.folder)

    def _find(self, kind: Kind, key: str) -> Path | None:
        return self.objects.find(kind, key) if _KEY.fullmatch(key) else None


def open_store() -> Store:
    """Return the store of this machine; `SUBT_CHECK_STORE` states what it shares with others.

    Raises:
        CheckerError: The address of the bucket is none, or there is no place for data.
    """
    folder, shared = data_folder(), os.environ.get("SUBT_CHECK_STORE", "")
    if not shared:
        return Store(folder)
    from checker.service.store.s3 import s3_objects

    return Store(folder, s3_objects(shared, folder))


def _is_of_result(name: str) -> bool:
    return name == SUMMARY or ARTEFACT_NAME.fullmatch(name) is not None


def _check_result(folder: Path) -> None:
    """Refuse what the child that wrote it had no reason to write: it has read hostile files.

    Raises:
        ValueError: There is a link, a device, a name of no artefact, or too much of all.
    """
    if folder.is_symlink():
        raise ValueError("a result is not a link")
    left = RESULT_LIMIT
    for path in folder.rglob("*"):
        name, status = path.relative_to(folder).as_posix(), path.lstat()
        if stat.S_ISDIR(status.st_mode) and "/" not in name:
            continue
        left -= status.st_size
        if not stat.S_ISREG(status.st_mode) or not _is_of_result(name):
            raise ValueError(f"{name[:200]!r} is not a file of a result")
        if left < 0:
            raise ValueError(f"a result has at most {RESULT_LIMIT / 1e9:g} GB")
