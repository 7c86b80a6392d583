"""Zip archives: their index, and the bytes of their entries."""

from __future__ import annotations

import io
import stat
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from checker.package.archive_index import ArchiveIndex, DamagedArchive, Member, plain_path

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
