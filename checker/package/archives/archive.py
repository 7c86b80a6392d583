"""Unpacking an untrusted archive: its whole index is checked before the first byte is written."""

from __future__ import annotations

import io
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Protocol

from checker.base.errors import UnreadableInput
from checker.package.archives.index import (
    ArchiveIndex,
    ArchiveLimits,
    DamagedArchive,
    Member,
    plain_path,
)
from checker.package.archives.tar_archive import read_tar_index, tar_contents

# Zip archives: their index, and the bytes of their entries.


# Room for 5 000 entries with long names; zipfile reads the index in one piece.
MAX_INDEX_BYTES = 4_000_000
_ENCRYPTED = 0x1 | 0x40 | 0x2000  # by password, by strong encryption, names hidden
_METHODS = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
_UNIX_KINDS = {0, stat.S_IFREG, stat.S_IFDIR}


class _SmallReads(io.FileIO):
    """A file that is read in small pieces only, so that no index fills the memory."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is None or size < 0:
            size = MAX_INDEX_BYTES
        if size > MAX_INDEX_BYTES:
            raise DamagedArchive("has an index of more entries than any package")
        return super().read(size) or b""


def read_zip_index(path: Path | int, index: ArchiveIndex) -> None:
    """Pass every entry of a zip archive to the index, which may refuse it."""
    own = isinstance(path, Path)
    with _SmallReads(path, closefd=own) as file, zipfile.ZipFile(file) as archive:
        for info in archive.infolist():
            _check(info, index)
            index.add(info.orig_filename, info.file_size, is_folder=_is_folder(info))


def _check(info: zipfile.ZipInfo, index: ArchiveIndex) -> None:
    name = info.orig_filename
    if info.flag_bits & _ENCRYPTED:
        raise index.refusal(name, "is encrypted")
    if info.compress_type not in _METHODS:
        raise index.refusal(name, "is compressed with another method than deflate")
    if stat.S_IFMT(info.external_attr >> 16) not in _UNIX_KINDS:
        raise index.refusal(name, "is a link or a device")
    if _is_folder(info) and info.file_size:
        raise index.refusal(name, "is a folder with content")


def _is_folder(info: zipfile.ZipInfo) -> bool:
    # ZipInfo.is_dir() fails on an entry without a name.
    return info.orig_filename.endswith("/")


def zip_contents(path: Path, index: ArchiveIndex) -> Iterator[tuple[Member, IO[bytes]]]:
    """Yield the checked files of a zip archive with their bytes."""
    members = {member.path: member for member in index.members if not member.is_folder}
    with _SmallReads(path) as file, zipfile.ZipFile(file) as archive:
        for info in archive.infolist():
            member = members.get(plain_path(info.orig_filename))
            if member is not None:
                with archive.open(info) as content:
                    yield member, content


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
            its suffix determines the format.
        limits: Limits for the content of the archive.

    Raises:
        RefusedArchive: An entry could do harm, or there is more than a package contains.
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
        name: The name, as for `unpack_archive`.
        limits: Limits for the content of the archive.
        descriptor: The descriptor of the file, where it cannot be opened by name; it stays open.

    Raises:
        RefusedArchive: An entry could do harm, or there is more than a package contains.
        UnreadableInput: The archive is truncated, damaged or empty, according to its index.
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
    """Write one file, and never more than its index entry states."""
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
        raise DamagedArchive(f"contains '{member.path}', whose stated size is wrong")


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
