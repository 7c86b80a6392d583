"""Uploads and results on disk, by hash and key: whole or not at all, whoever dies meanwhile.

    uploads/ab/<hash>          what was uploaded, once however often
    results/ab/<key>/…         reports; a key depends on all that a report depends on
    incoming/<random>…         work in progress
    parts/ab/abcd…/            what checks of an upload have worked out (`checker.base.cache`)

Many processes use it at once, on several machines where they share the folder.
"""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import stat
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from checker.base.files import tighten, tighten_below
from checker.base.record import Record
from checker.report.files import ARTEFACT_NAME
from checker.service.store.place import DATABASE
from checker.service.store.workplace import (
    Incoming,
    TooLarge,
    move,
    rename,
    settle,
    settle_below,
    settle_name,
    sweep,
    work_file,
    workplace,
)

__all__ = ["DEFAULT_UPLOAD_LIMIT", "SUMMARY", "Incoming", "Store", "TooLarge"]

DEFAULT_UPLOAD_LIMIT = 100_000_000
"""Bytes."""
SUMMARY = "summary.json"
"""In each result, for the engine alone: what the state of a check says of its packages."""
RESULT_LIMIT = 1_000_000_000
"""Bytes of one result."""
CACHE_SECONDS = 86_400.0
"""That parts of a check are kept beyond their last use: for its second stage, and for the same
upload with another profile."""
_OURS = ("uploads", "results", "incoming", "parts", "workers", "cache", "lock")
_KEY = re.compile(r"[0-9a-f]{64}")


class Store(Record):
    """What was uploaded and what was found out about it.

    Attributes:
        folder: Where all of it lies; made when something comes.
    """

    folder: Path

    @contextmanager
    def incoming(self, limit: int = DEFAULT_UPLOAD_LIMIT) -> Iterator[Incoming]:
        """Take an upload of at most `limit` bytes; without its `finish`, nothing of it is left."""
        self._make()
        with work_file(self.folder / "incoming") as (path, descriptor):
            yield Incoming(path, descriptor, limit, self.admit)

    def admit(self, file: Path, hash: str) -> None:
        """Keep an upload that has come whole, safe from a power failure.

        Args:
            file: Of `Incoming`; it is gone after.
            hash: Of its content, as `Incoming.finish` says it.
        """
        settle(file)
        place = self.folder / "uploads" / hash[:2] / hash
        with self._alone():
            rename(file, place)
        settle_name(place)

    @contextmanager
    def workplace(self) -> Iterator[Path]:
        """Make a folder for work in progress; it goes at the end, or by `sweep` if we die."""
        self._make()
        with workplace(self.folder / "incoming") as place:
            yield place

    def parts(self, hash: str) -> Path | None:
        """Return the folder of what checks of an upload have worked out, for others of the same."""
        return self._place("parts", hash)

    def upload(self, hash: str) -> Path | None:
        """Return the file of an upload; None if it is not there."""
        place = self._place("uploads", hash)
        return place if place is not None and place.is_file() else None

    def has(self, key: str) -> bool:
        """Whether a result is there; it counts as used now, so that it does not expire soon."""
        place = self._place("results", key)
        if place is None or not place.exists():  # most are new: nobody waits for these
            return False
        with self._alone():
            return _touched(place)

    def keep(self, key: str, folder: Path) -> None:
        """Move a finished folder of artefacts into place; the first one of a key wins.

        Args:
            key: Of the result, 64 hexadecimal digits.
            folder: On the file system of the store, such as in a `workplace`; it is gone after.

        Raises:
            ValueError: The key is none, or the folder holds what no result does.
        """
        place = self._place("results", key)
        if place is None:
            raise ValueError(f"{key!r} is not the key of a result")
        _check_result(folder)
        settle_below(folder)
        with self._alone():
            if not _touched(place):
                move(folder, place)
        shutil.rmtree(folder, ignore_errors=True)

    def file(self, key: str, name: str) -> Path | None:
        """Return a file of a result by its name, such as `pkg/robot.glb`; None if there is none."""
        place = self._place("results", key)
        if place is None or not _is_of_result(name):
            return None
        path = place / name
        try:
            return path if path.is_file() else None
        except OSError:  # no file system has names as long
            return None

    def names(self, key: str) -> tuple[str, ...]:
        """Return the names of a result's files that are for people and programs, sorted."""
        place = self._place("results", key)
        if place is None:
            return ()
        try:
            names = [path.relative_to(place).as_posix() for path in place.rglob("*")]
        except FileNotFoundError:  # it expires just now
            return ()
        return tuple(sorted(name for name in names if ARTEFACT_NAME.fullmatch(name)))

    def expire(self, before: float, still_used: Collection[str]) -> None:
        """Remove what nobody has come back to.

        Args:
            before: Seconds since the epoch; what was used later stays.
            still_used: Hashes and keys that stay whatever their age.
        """
        with self.workplace() as place:
            for kind in ("uploads", "results"):
                for path in (self.folder / kind).glob("[0-9a-f][0-9a-f]/*"):
                    if path.name not in still_used:
                        self._expire_one(path, before, place)
            for path in (self.folder / "parts").glob("[0-9a-f][0-9a-f]/*"):
                self._expire_one(path, before - CACHE_SECONDS, place)
            # 0.1.0 shared what it had worked out between uploads.
            with suppress(FileNotFoundError):
                (self.folder / "cache").rename(place / "cache")

    @property
    def workers(self) -> Path:
        """The folder of `checker.service.store.life`."""
        return self.folder / "workers"

    def sweep(self) -> None:
        """Remove the temporary files of processes that have died."""
        sweep(self.folder / "incoming")

    def tighten(self) -> None:
        """Take from other users what an older version, or a copy, has left them of all this.

        What else lies in the folder is not ours; then the folder itself stays as it is.
        """
        for name in _OURS:
            tighten_below(self.folder / name)
        with suppress(FileNotFoundError):
            names = os.listdir(self.folder)  # noqa: PTH208 - names are all that is asked for
            if all(name in _OURS or name.startswith(DATABASE) for name in names):
                tighten(self.folder)

    def _expire_one(self, path: Path, before: float, place: Path) -> None:
        with self._alone(), suppress(FileNotFoundError):
            if path.stat().st_mtime < before:
                # A folder goes at once; its files go when the workplace does.
                path.rename(place / path.name)

    def _place(self, kind: str, key: str) -> Path | None:
        return self.folder / kind / key[:2] / key if _KEY.fullmatch(key) else None

    def _make(self) -> None:
        """Make the folder, for its owner alone, where it is not there yet."""
        self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Keep others from removing what is just being used again, for a moment."""
        self._make()
        lock = os.open(self.folder / "lock", os.O_RDWR | os.O_CREAT, 0o600)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield
        finally:
            os.close(lock)


def _is_of_result(name: str) -> bool:
    return name == SUMMARY or ARTEFACT_NAME.fullmatch(name) is not None


def _touched(place: Path) -> bool:
    try:
        os.utime(place)
    except FileNotFoundError:
        return False
    return True


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
