"""Objects in a bucket of S3, which all machines reach; each keeps copies of those it uses.

`uploads/ab/<hash>/content` is what was uploaded, `results/ab/<key>/content` and
`parts/ab/<hash>/content` are zips of folders. The time of the empty object `used` next to it states
when it was last used. Copies are in a folder as in a service without S3 (`FolderObjects`).
"""

from __future__ import annotations

import logging
import os
import time
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from datetime import timedelta
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING
from zipfile import ZIP_DEFLATED, ZipFile

from checker.base.errors import InvalidSettings
from checker.base.extras import S3
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.store.folder import FolderObjects
from checker.service.store.objects import Kind, StoreUnreachable
from checker.service.store.workplace import work_file, workplace

if TYPE_CHECKING:
    from obstore import ObjectMeta
    from obstore.store import RetryConfig, S3Store

COPY_SECONDS = 600.0
"""Time that copies are kept after their last use."""
_PIECE = 1_048_576
_SHOWN = 300
_LOG = logging.getLogger(__name__)
_CONTENT, _USED = "content", "used"
_CONNECT_SECONDS, _SECONDS = timedelta(seconds=3), timedelta(seconds=60)
"""Time limits of one request; large objects go in several."""
_TRIES: RetryConfig = {"max_retries": 2, "retry_timeout": timedelta(seconds=10)}


class S3Objects(Record):
    """Objects in a bucket; see `Objects`.

    Attributes:
        bucket: The bucket, with the prefix of all objects.
        copies: The folder of copies on this machine.
    """

    bucket: S3Store
    copies: FolderObjects

    def find(self, kind: Kind, key: str) -> Path | None:
        """Return the copy of an object, fetched if needed; None if there is no such object."""
        if not self.copies.use(kind, key):
            self._fetch(kind, key)
        return self.copies.find(kind, key)

    def names(self, kind: Kind, key: str) -> tuple[str, ...]:
        """Return the names of the files of a copy, fetched if needed."""
        self.find(kind, key)
        return self.copies.names(kind, key)

    def use(self, kind: Kind, key: str) -> bool:
        """Return whether an object exists, and mark it as used now."""
        from obstore import head, put

        with _answers(), suppress(FileNotFoundError):
            head(self.bucket, _name(kind, key, _CONTENT))
            put(self.bucket, _name(kind, key, _USED), b"")
            return True
        return False

    def put(self, kind: Kind, key: str, source: Path) -> None:
        """Keep a file or folder: once it is in the bucket, all of it is."""
        if source.is_dir():
            self._put_folder(kind, key, source)
        else:
            self._put_file(kind, key, source)
        self.copies.put(kind, key, source)

    def add(self, kind: Kind, key: str, source: Path) -> None:
        """Add the files of a folder to those of the copy, and keep all of them."""
        self.copies.add(kind, key, source)
        if (folder := self.copies.find(kind, key)) is not None:
            self._put_folder(kind, key, folder)

    def expire(self, kind: Kind, before: float, still_used: Collection[str]) -> int:
        """Remove objects that were last used before a time, unless their key is still used.

        S3 has no locks: an object that is used again between the last look and its removal, some
        milliseconds, is lost.

        Returns:
            How many went.
        """
        from obstore import delete

        number = 0
        for key, _ in self._old(kind, before):
            if key not in still_used:
                number += 1
                with _answers():
                    for _, names in self._old(_name(kind, key), before):
                        delete(self.bucket, names)
        return number

    def sweep(self) -> None:
        """Remove copies that were not used lately."""
        for kind in Kind:
            self.copies.expire(kind, time.time() - COPY_SECONDS, ())

    def _old(self, prefix: str, before: float) -> Iterator[tuple[str, list[str]]]:
        """Yield keys of objects that were last used before a time, with the names that go."""
        for folder, metas in groupby(self._listed(prefix), lambda meta: _folder(meta["path"])):
            entries = list(metas)
            if max(meta["last_modified"].timestamp() for meta in entries) < before:
                yield folder.rpartition("/")[2], [meta["path"] for meta in entries]

    def _listed(self, prefix: str) -> Iterator[ObjectMeta]:
        from obstore import list as listed

        with _answers():
            for chunk in listed(self.bucket, prefix):
                yield from chunk

    def _fetch(self, kind: Kind, key: str) -> None:
        from obstore import get

        with work_file(self.copies.folder / "incoming") as (file, descriptor):
            try:
                with _answers():
                    for piece in get(self.bucket, _name(kind, key, _CONTENT)).stream(_PIECE):
                        _write(descriptor, piece)
            except FileNotFoundError:
                return
            if kind is Kind.UPLOAD:
                self.copies.put(kind, key, file)
                return
            with workplace(self.copies.folder / "incoming") as place, ZipFile(file) as packed:
                packed.extractall(place / "made")
                self.copies.put(kind, key, place / "made")

    def _put_folder(self, kind: Kind, key: str, folder: Path) -> None:
        with work_file(self.copies.folder / "incoming") as (file, _):
            with ZipFile(file, "w", ZIP_DEFLATED, compresslevel=1) as packed:
                for path in sorted(folder.rglob("*")):
                    packed.write(path, path.relative_to(folder))
            self._put_file(kind, key, file)

    def _put_file(self, kind: Kind, key: str, file: Path) -> None:
        from obstore import put

        try:
            with _answers():
                put(self.bucket, _name(kind, key, _CONTENT), file)
        except FileNotFoundError:
            raise StoreUnreachable("its bucket does not exist") from None


def s3_objects(url: str, copies: Path) -> S3Objects:
    """Return the objects in a bucket; credentials and region are in the variables of AWS.

    Args:
        url: `s3://BUCKET/PREFIX`.
        copies: Folder of this machine's copies.

    Raises:
        CheckerError: The address is none, or the extra is not installed.
    """
    S3.require_for("SUBT_CHECK_STORE")
    from obstore.exceptions import BaseError
    from obstore.store import S3Store

    in_clear = os.environ.get("AWS_ENDPOINT_URL", "").startswith("http://")
    try:
        if not url.startswith("s3://"):
            raise ValueError
        bucket = S3Store.from_url(
            url,
            client_options={
                "connect_timeout": _CONNECT_SECONDS,
                "timeout": _SECONDS,
                "allow_http": in_clear,
            },
            retry_config=_TRIES,
        )
    except (BaseError, ValueError):
        problem = f"SUBT_CHECK_STORE is {url!r}, expected for example 's3://bucket/prefix'"
        raise InvalidSettings(None, problem) from None
    return S3Objects(bucket, FolderObjects(copies))


def _name(kind: Kind, key: str, *last: str) -> str:
    return "/".join((kind, key[:2], key, *last))


def _folder(path: str) -> str:
    return path.rpartition("/")[0]


def _write(descriptor: int, piece: bytes) -> None:
    left = memoryview(piece)
    while left:  # a disk that is nearly full takes a part of it
        left = left[os.write(descriptor, left) :]


@contextmanager
def _answers() -> Iterator[None]:
    """State of a bucket that does not answer, or refuses, that it is unreachable."""
    from obstore.exceptions import BaseError

    try:
        yield
    except (BaseError, PermissionError) as error:
        # What follows its first line are addresses and data of the library.
        _LOG.warning(
            "the object store: %s", plain(shortened(str(error).partition("\n")[0], _SHOWN))
        )
        raise StoreUnreachable("the object store does not answer") from error
