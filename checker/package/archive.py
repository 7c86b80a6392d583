"""Unpacking a stranger's archive: its whole index is checked before the first byte is written."""

from __future__ import annotations

import os
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from checker.errors import UnreadableInput
from checker.package.archive_index import ArchiveIndex, ArchiveLimits, DamagedArchive, Member
from checker.package.tar_archive import read_tar_index, tar_contents
from checker.package.zip_archive import read_zip_index, zip_contents

ARCHIVE_SUFFIXES = (".zip", ".tar.gz", ".tgz")
CHUNK = 65_536
# What zipfile and zlib raise on bytes that are no archive.
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    DamagedArchive,
    EOFError,
    NotImplementedError,
    OverflowError,
    RuntimeError,
    ValueError,
)


class _Readable(Protocol):
    def read(self, size: int, /) -> bytes: ...


_Contents = Callable[[Path, ArchiveIndex], Iterator[tuple[Member, _Readable]]]


def unpack_archive(
    archive: Path, target: Path, name: str = "", limits: ArchiveLimits | None = None
) -> None:
    """Unpack a zip or gzipped tar archive into an empty folder.

    Args:
        archive: The file.
        target: An empty folder of our own.
        name: The archive's name as the user knows it, when the file is stored under another;
            its suffix tells the format.
        limits: What the archive may hold.

    Raises:
        RefusedArchive: An entry could do harm, or there is more than a package holds.
        UnreadableInput: The archive is truncated, damaged, empty, or cannot be written out.
    """
    with _checked_index(archive, name, limits) as (index, contents):
        for member in index.members:
            if member.is_folder:
                (target / member.path).mkdir(parents=True, exist_ok=True)
        for member, content in contents(archive, index):
            _write(target / member.path, member, content)


def check_archive(
    archive: Path,
    name: str = "",
    limits: ArchiveLimits | None = None,
    descriptor: int | None = None,
) -> None:
    """Read the index of an archive as `unpack_archive` does, and write nothing.

    Args:
        archive: The file.
        name: As for `unpack_archive`.
        limits: What the archive may hold.
        descriptor: Of the file, for who cannot open it; it stays open.

    Raises:
        RefusedArchive: An entry could do harm, or there is more than a package holds.
        UnreadableInput: The archive is truncated, damaged or empty, as far as its index tells.
    """
    with _checked_index(archive, name, limits, descriptor):
        pass


@contextmanager
def _checked_index(
    archive: Path, name: str, limits: ArchiveLimits | None, descriptor: int | None = None
) -> Iterator[tuple[ArchiveIndex, _Contents]]:
    """Read the index; damage that shows then, or while the contents are read, is reported."""
    is_zip = (name or archive.name).lower().endswith(".zip")
    read_index = read_zip_index if is_zip else read_tar_index
    contents: _Contents = zip_contents if is_zip else tar_contents
    with _damage_reported(archive, "zip" if is_zip else "tar.gz"):
        source = archive if descriptor is None else descriptor
        size = os.stat(source).st_size  # noqa: PTH116 - or a descriptor
        index = ArchiveIndex(archive, size, limits or ArchiveLimits())
        read_index(source, index)
        if all(member.is_folder for member in index.members):
            raise UnreadableInput(archive, "contains no files", "pack the package folder itself")
        yield index, contents


def _write(path: Path, member: Member, content: _Readable) -> None:
    """Write one file, and never more than its index entry says."""
    path.parent.mkdir(parents=True, exist_ok=True)
    left = member.size
    # "x" refuses whatever stands there already.
    with path.open("xb") as file:
        while piece := content.read(CHUNK):
            left -= len(piece)
            if left < 0:
                break
            file.write(piece)
    if left:
        raise DamagedArchive(f"says that '{member.path}' has {member.size} bytes, but it has not")


@contextmanager
def _damage_reported(archive: Path, form: str) -> Iterator[None]:
    try:
        yield
    except DamagedArchive as error:
        raise _damaged(archive, f"is a damaged {form} archive: it {error}") from None
    except _DAMAGE as error:
        raise _damaged(archive, f"is not a {form} archive, or is cut off ({error})") from None
    except OSError as error:
        reason = f"cannot be unpacked: {error.strerror or error}"
        raise UnreadableInput(archive, reason, "check the file and the free disk space") from None


def _damaged(archive: Path, reason: str) -> UnreadableInput:
    return UnreadableInput(archive, reason, "pack or download it again")
