"""Width and height of a picture file, from its header alone."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator

# Whether a picture is a whole PNG file, without unpacking its pixels.


_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_AROUND = 12
"""Bytes of a chunk beside its data: length, kind and check sum."""

_OTHERS = {
    b"\xff\xd8\xff": "a JPEG file",
    b"GIF8": "a GIF file",
    b"BM": "a BMP file",
    b"<svg": "an SVG file",
    b"version https://git-lfs": "a pointer of Git LFS, not the picture",
}


def png_fault(data: bytes) -> str | None:
    """Return why the bytes are no whole PNG file, as the end of a sentence; None if they are.

    Signature, chunks and their check sums are looked at (PNG specification, second edition, 5).
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
        return "is damaged: it holds no picture"
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
