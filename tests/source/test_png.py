"""A picture is a PNG file when its signature, chunks and check sums are whole."""

from __future__ import annotations

import struct
import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.binary_headers import png_fault


def chunk(kind: bytes, data: bytes) -> bytes:
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


HEADER = chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
PIXELS = chunk(b"IDAT", zlib.compress(b"\0\x80"))
END = chunk(b"IEND", b"")
SIGNATURE = b"\x89PNG\r\n\x1a\n"
WHOLE = SIGNATURE + HEADER + PIXELS + END


@pytest.mark.parametrize("behind", [b"", b"\n", bytes(200)])
def test_a_whole_file_has_no_fault_whatever_stands_behind_it(behind: bytes) -> None:
    assert png_fault(WHOLE + behind) is None


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "empty"),
        (b"\xff\xd8\xff\xe0", "JPEG"),
        (b"version https://git-lfs.github.com/spec/v1", "Git LFS"),
        (b"hello", "no PNG"),
        (SIGNATURE, "cut off"),
        (SIGNATURE + HEADER + END, "contains no picture"),
        (SIGNATURE + PIXELS + END, "contains no picture"),
        (SIGNATURE + HEADER + PIXELS, "cut off"),
    ],
)
def test_what_is_wrong_is_named(data: bytes, words: str) -> None:
    assert words in (png_fault(data) or "")


@given(st.integers(0, len(WHOLE) - 1))
def test_a_file_cut_anywhere_is_faulty(end: int) -> None:
    assert png_fault(WHOLE[:end]) is not None


@given(st.integers(0, len(WHOLE) - 1), st.integers(1, 255))
def test_a_changed_byte_is_noticed(at: int, change: int) -> None:
    damaged = bytearray(WHOLE)
    damaged[at] ^= change
    assert png_fault(bytes(damaged)) is not None


@given(st.binary())
def test_no_bytes_raise(data: bytes) -> None:
    png_fault(SIGNATURE + data)
