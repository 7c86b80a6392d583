"""Gzipped tar archives, read as a stream in which every step is bounded.

The standard library's tarfile holds extended headers of any size in memory and searches them by
slow patterns; what packages need of the format (POSIX ustar and pax, GNU long names) is small.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from checker.package.archives.index import (
    ArchiveIndex,
    DamagedArchive,
    Member,
    plain_path,
)

# A gzip file as a stream of at most so many bytes, whatever it promises.


CHUNK = 65_536


class GzipStream:
    """The unpacked bytes of a gzip file, at most `bound` of them."""

    def __init__(self, file: IO[bytes], bound: int) -> None:
        self._file = file
        self._left = bound
        self._packed = b""
        self._inflate = zlib.decompressobj(16 + zlib.MAX_WBITS)

    def read(self, size: int) -> bytes:
        """Return `size` bytes, fewer only at the end.

        Raises:
            DamagedArchive: The file ends early, or contains more than the bound.
        """
        pieces = []
        while size > 0 and not self._inflate.eof:
            if not self._packed:
                self._packed = self._file.read(CHUNK)
                if not self._packed:
                    raise DamagedArchive("ends too early")
            piece = self._inflate.decompress(self._packed, min(size, CHUNK))
            self._packed = self._inflate.unconsumed_tail
            size -= len(piece)
            self._left -= len(piece)
            if self._left < 0:
                raise DamagedArchive("unpacks to far more than the sizes of its entries")
            pieces.append(piece)
        return b"".join(pieces)


BLOCK = 512
MAX_EXTENDED_HEADER = 1_000_000
MAX_EXTENDED_HEADERS = 16_000_000
"""Bytes of all extended headers of an archive."""
MAX_RECORDS = 100
"""Greatest number in one extended header; those of real archives have fewer than ten."""
# Headers, padding and extended headers around each entry's content.
OVERHEAD_PER_ENTRY = 4_096
_HEADERS_PER_ENTRY = 4
"""Greatest number: its own, and those of a long name, a long target and further fields."""

_OCTAL = re.compile(rb"[\0 ]*([0-7]*)[\0 ]*\Z")
_FILES = {b"0", b"\0", b"7"}
_FOLDER = b"5"
_PAX = b"x"
_LONG_NAME = b"L"
# Global pax headers and long link targets say nothing about a file's name or size.
_EXTENDED = {_PAX, _LONG_NAME, b"g", b"K"}
_REFUSED = {
    b"1": "is a hard link",
    b"2": "is a symbolic link",
    b"3": "is a device",
    b"4": "is a device",
    b"6": "is a pipe",
    b"S": "is a sparse file",
}


@dataclass
class TarEntry:
    """One entry, whose content is read from the stream before the next entry is."""

    name: str
    kind: bytes
    size: int
    _stream: GzipStream
    _left: int = 0

    def __post_init__(self) -> None:
        self._left = self.size

    @property
    def is_folder(self) -> bool:
        """True if it is a folder; in old archives, its name ends with a slash."""
        return self.kind == _FOLDER or (self.kind == b"\0" and self.name.endswith("/"))

    def read(self, size: int = CHUNK, /) -> bytes:
        """Return the next bytes of the content, at most `size`."""
        data = self._stream.read(min(size, self._left))
        if not data and min(size, self._left) > 0:
            raise DamagedArchive("ends in the middle of an entry")
        self._left -= len(data)
        return data

    def skip(self) -> None:
        """Go to the end of the content and its padding."""
        while self.read(CHUNK):
            pass
        self._stream.read(-self.size % BLOCK)


def tar_entries(stream: GzipStream, most: int) -> Iterator[TarEntry]:
    """Yield the entries of a tar stream; extended headers are applied to the entry behind them.

    Args:
        stream: The archive, unpacked.
        most: Headers of all kinds.

    Raises:
        DamagedArchive: The stream ends early, or contains something else, or more headers.
    """
    extended: dict[str, bytes] = {}
    headers = bytes_of_extended = 0
    while header := stream.read(BLOCK):
        headers += 1
        if headers > most:
            raise DamagedArchive("has more headers than any package")
        if len(header) < BLOCK:
            raise DamagedArchive("ends in the middle of an entry")
        if not any(header):
            return
        _verify(header)
        if header[156:157] in _EXTENDED:
            entry = _entry(header, {}, stream)
            bytes_of_extended += entry.size
            if entry.size > MAX_EXTENDED_HEADER or bytes_of_extended > MAX_EXTENDED_HEADERS:
                raise DamagedArchive("has extended headers that are too large")
            extended.update(_overrides(entry))
            entry.skip()
        else:
            entry = _entry(header, extended, stream)
            extended = {}
            yield entry
            entry.skip()


def _verify(header: bytes) -> None:
    """Check the header's sum, in which the sum's own field counts as blanks."""
    if sum(header[:148]) + 8 * 0x20 + sum(header[156:]) != _number(header[148:156]):
        raise DamagedArchive("has an entry whose checksum is wrong")


def _entry(header: bytes, extended: dict[str, bytes], stream: GzipStream) -> TarEntry:
    name = _text(header[:100])
    if header[257:263] == b"ustar\0" and (prefix := _text(header[345:500])):
        name = f"{prefix}/{name}"
    size = _number(header[124:136])
    kind = header[156:157]
    if "path" in extended:
        name = _text(extended["path"])
    if "size" in extended:
        size = _decimal(extended["size"])
    if any(key.startswith("GNU.sparse") for key in extended):
        kind = b"S"
    return TarEntry(name, kind, size, stream)


def _text(field: bytes) -> str:
    return field.split(b"\0", 1)[0].decode("utf-8", "surrogateescape")


def _number(field: bytes) -> int:
    """Read an octal number, or the binary one that GNU tar writes for large files."""
    if field[0] == 0x80:
        return int.from_bytes(field[1:], "big")
    match = _OCTAL.match(field)
    if match is None:
        raise DamagedArchive("has an entry with an invalid number")
    return int(match[1] or b"0", 8)


def _decimal(text: bytes) -> int:
    if not (text.isdigit() and len(text) < 20):
        raise DamagedArchive("has an entry with an invalid number")
    return int(text)


def _overrides(entry: TarEntry) -> dict[str, bytes]:
    """Return what an extended header states about the next entry."""
    data = entry.read(entry.size)
    if entry.kind == _LONG_NAME:
        return {"path": data}
    return _pax_records(data) if entry.kind == _PAX else {}


def _pax_records(data: bytes) -> dict[str, bytes]:
    """Read the records `<length> <key>=<value>` and a line end of a pax header."""
    records: dict[str, bytes] = {}
    at = number = 0
    while at < len(data):
        number += 1
        if number > MAX_RECORDS:
            raise DamagedArchive(f"has an extended header with more than {MAX_RECORDS} records")
        digits, _, _ = data[at : at + 20].partition(b" ")
        length = _decimal(digits)
        record = data[at + len(digits) + 1 : at + length]
        if length < len(digits) + 4 or not record.endswith(b"\n"):
            raise DamagedArchive("has an invalid extended header")
        key, _, value = record[:-1].partition(b"=")
        records[key.decode("utf-8", "replace")] = value
        at += length
    return records


def read_tar_index(path: Path | int, index: ArchiveIndex) -> None:
    """Pass every entry of a gzipped tar archive to the index, which may refuse it."""
    with open(path, "rb", closefd=isinstance(path, Path)) as file:
        for entry in _entries(file, index):
            if entry.kind in _REFUSED:
                raise index.refusal(entry.name, _REFUSED[entry.kind])
            if entry.kind != _FOLDER and entry.kind not in _FILES:
                raise index.refusal(entry.name, "is neither a file nor a folder")
            if entry.is_folder and entry.size:
                raise index.refusal(entry.name, "is a folder with content")
            index.add(entry.name, entry.size, is_folder=entry.is_folder)


def tar_contents(path: Path, index: ArchiveIndex) -> Iterator[tuple[Member, TarEntry]]:
    """Yield the checked files of a gzipped tar archive with their bytes."""
    members = {member.path: member for member in index.members if not member.is_folder}
    with path.open("rb") as file:
        for entry in _entries(file, index):
            member = members.get(plain_path(entry.name))
            if member is not None:
                yield member, entry


def _entries(file: IO[bytes], index: ArchiveIndex) -> Iterator[TarEntry]:
    entries = index.limits.entries + 1
    stream = GzipStream(file, index.allowed_bytes + entries * OVERHEAD_PER_ENTRY)
    return tar_entries(stream, entries * _HEADERS_PER_ENTRY)
