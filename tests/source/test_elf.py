"""Shared libraries: what their headers say, and that no file keeps their reader."""

from __future__ import annotations

import struct
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.binary_headers import SharedLibrary, read_shared_library

X64, X86, AARCH64 = 62, 3, 183
STRINGS = 0x300


def library(machine: int = X64, needed: tuple[bytes, ...] = (), segments: int = 2) -> bytes:
    """Return an ELF file of headers, one dynamic section and its strings."""
    strings = b"\0" + b"".join(name + b"\0" for name in needed)
    tags, at = b"", 1
    for name in needed:
        tags += struct.pack("<2Q", 1, at)
        at += len(name) + 1
    tags += struct.pack("<6Q", 5, STRINGS, 10, len(strings), 0, 0)
    ident = b"\x7fELF\2\1\1"
    counts = (64, 56, segments, 64, 0, 0)
    header = struct.pack("<16sHHIQQQIHHHHHH", ident, 3, machine, 1, 0, 64, 0, 0, *counts)
    load = struct.pack("<IIQQQQQQ", 1, 4, 0, 0, 0, 0x1000, 0x1000, 8)
    dynamic = struct.pack("<IIQQQQQQ", 2, 4, 0x200, 0x200, 0x200, len(tags), len(tags), 8)
    whole = (header + load + dynamic).ljust(0x200, b"\0") + tags
    return (whole.ljust(STRINGS, b"\0") + strings).ljust(0x1000, b"\0")


@pytest.mark.parametrize(("code", "name"), [(X64, "x64"), (X86, "x86"), (AARCH64, "AArch64")])
def test_the_machine_is_named(code: int, name: str) -> None:
    assert read_shared_library(library(code)) == SharedLibrary(name, ())


def test_needed_libraries_are_listed_in_order() -> None:
    names = ("libignition-gazebo4.so.4", "libstdc++.so.6")
    found = read_shared_library(library(needed=tuple(name.encode() for name in names)))
    assert found == SharedLibrary("x64", names)


def test_a_real_library_is_read() -> None:
    from lxml import etree

    path = Path(etree.__file__)
    if sys.platform != "linux" or path.suffix != ".so":
        pytest.skip("there is no ELF library here")
    found = read_shared_library(path.read_bytes())
    assert found is not None
    assert any(name.startswith("libc.so") for name in found.needed)


@pytest.mark.parametrize("data", [b"", b"\x7fELF", b"version https://git-lfs", b"\0" * 5000])
def test_what_is_no_library_is_none(data: bytes) -> None:
    assert read_shared_library(data) is None


def test_a_dynamic_section_without_end_is_given_up() -> None:
    endless = struct.pack("<2Q", 1, 1) * 200_000
    file = bytearray(library())
    dynamic = struct.pack("<IIQQQQQQ", 2, 4, 0x1000, 0x1000, 0x1000, 16, 16, 8)
    file[120 : 120 + len(dynamic)] = dynamic
    file[STRINGS:0x1000] = b"a" * (0x1000 - STRINGS)
    assert read_shared_library(bytes(file) + endless) is None


def test_a_string_without_end_is_not_read_again_and_again() -> None:
    file = bytearray(library(needed=(b"",) * 10))
    file[STRINGS:] = b"a" * (len(file) - STRINGS) + b"a" * 5_000_000
    assert read_shared_library(bytes(file)) is None


def test_more_segments_than_the_file_holds_are_given_up() -> None:
    assert read_shared_library(library(segments=0xFFFE)) is None


@given(st.binary(max_size=300), st.integers(0, 0x340))
def test_damage_is_survived(damage: bytes, at: int) -> None:
    file = bytearray(library(needed=(b"libm.so.6",)))
    file[at : at + len(damage)] = damage
    found = read_shared_library(bytes(file))
    assert found is None or all(isinstance(name, str) for name in found.needed)
