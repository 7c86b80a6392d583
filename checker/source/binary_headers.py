"""Headers of binary files: the size of a picture, the machine of a shared library.

Only headers and the dynamic section are read. The file is not trusted, so its reader gets a budget:
offsets and counts in it may have any value.
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator

from checker.base.record import Record

# Width and height of a picture file, from its header alone.


# Whether a picture is a whole PNG file, without unpacking its pixels.


_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_AROUND = 12
"""Bytes of a chunk besides its data: length, kind and check sum."""

LFS_POINTER = b"version https://git-lfs"
"""How the file begins that Git LFS leaves in the place of one that is not fetched."""
_OTHERS = {
    b"\xff\xd8\xff": "a JPEG file",
    b"GIF8": "a GIF file",
    b"BM": "a BMP file",
    b"<svg": "an SVG file",
    LFS_POINTER: "a Git LFS pointer, not the picture",
}


def png_fault(data: bytes) -> str | None:
    """Return why the bytes are no whole PNG file, as the end of a sentence; None if they are.

    Signature, chunks and their check sums are read (PNG specification, second edition, 5).
    """
    if not data.startswith(_SIGNATURE):
        other = next((name for start, name in _OTHERS.items() if data.startswith(start)), None)
        return f"is {other or 'no PNG file'}" if data else "is empty"
    kinds = []
    for kind, is_whole in _chunks(data):
        if not is_whole:
            return f"is damaged: the check sum of its part {kind.decode('latin-1')!r} is wrong"
        kinds.append(kind)
    if kinds and (kinds[0] != b"IHDR" or (kinds[-1] == b"IEND" and b"IDAT" not in kinds)):
        return "is damaged: it contains no picture"
    return None if kinds[-1:] == [b"IEND"] else "is cut off"


def _chunks(data: bytes) -> Iterator[tuple[bytes, bool]]:
    """Yield each complete chunk up to the last, and whether its check sum is right."""
    at, kind = len(_SIGNATURE), b""
    while kind != b"IEND" and at + _AROUND <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        end = at + _AROUND + length
        if end > len(data):
            break
        (check_sum,) = struct.unpack_from(">I", data, end - 4)
        yield kind, zlib.crc32(memoryview(data)[at + 4 : end - 4]) == check_sum
        at = end


_PNG = b"\x89PNG\r\n\x1a\n"
_JPEG = b"\xff\xd8"

_FRAMES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""JPEG markers of a frame, which states the size (ITU-T T.81, table B.1)."""


def picture_size(data: bytes) -> tuple[int, int] | None:
    """Return the width and height of a PNG or JPEG file in pixels; None of anything else."""
    if data.startswith(_PNG) and data[12:16] == b"IHDR" and len(data) >= 24:
        width, height = struct.unpack_from(">II", data, 16)
        return width, height
    return _jpeg_size(data) if data.startswith(_JPEG) else None


def _jpeg_size(data: bytes) -> tuple[int, int] | None:
    """Walk the segments, each a marker and its length, up to the first frame."""
    at = len(_JPEG)
    while at + 9 <= len(data) and data[at] == 0xFF:
        marker = data[at + 1]
        if marker == 0xFF:  # a fill byte
            at += 1
            continue
        if marker in _FRAMES:
            height, width = struct.unpack_from(">HH", data, at + 5)
            return width, height
        (length,) = struct.unpack_from(">H", data, at + 2)
        at += 2 + length
    return None


BUDGET = 1_000_000
"""Bytes that may be read of one file; real libraries need a few thousand."""
_COST = 32
"""Cost of every read in addition to its bytes, so that empty reads end too."""


class SharedLibrary(Record):
    """Headers of an ELF file.

    Attributes:
        machine: The name as pyelftools names it: `x64`, `x86`, `AArch64`.
        needed: File names of the libraries it is linked to: `libignition-gazebo4.so.4`.
    """

    machine: str
    needed: tuple[str, ...]


def read_shared_library(data: bytes) -> SharedLibrary | None:
    """Read the headers of an ELF file; None if it is none or makes no sense.

    Args:
        data: The whole file.
    """
    from elftools.common.exceptions import ELFError
    from elftools.elf.dynamic import DynamicSegment
    from elftools.elf.elffile import ELFFile

    try:
        elf = ELFFile(_Budgeted(data))
        needed = [
            str(tag.needed)  # type: ignore[attr-defined]  # set by name in its constructor
            for segment in elf.iter_segments()
            if isinstance(segment, DynamicSegment)
            for tag in segment.iter_tags()
            if tag["d_tag"] == "DT_NEEDED"
        ]
        return SharedLibrary(elf.get_machine_arch(), tuple(needed))
    except (ELFError, ArithmeticError, AssertionError, AttributeError, LookupError, TypeError):
        return None
    except ValueError:  # text that is no UTF-8, negative offsets
        return None


class _BudgetSpent(ValueError):
    """Too much was read."""


class _Budgeted(io.BytesIO):
    """A file of which only so much may be read."""

    _left = BUDGET

    def read(self, size: int | None = -1, /) -> bytes:
        """Read as usual.

        Raises:
            _BudgetSpent: The file makes its reader go round.
        """
        data = super().read(size)
        self._left -= len(data) + _COST
        if self._left < 0:
            raise _BudgetSpent
        return data
