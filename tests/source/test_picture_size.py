"""Width and height out of the headers of PNG and JPEG files."""

from __future__ import annotations

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.binary_headers import picture_size


@pytest.mark.parametrize("kind", ["PNG", "JPEG"])
@pytest.mark.parametrize("size", [(1, 1), (640, 480), (33, 5000)])
def test_of_a_picture(kind: str, size: tuple[int, int]) -> None:
    pil = pytest.importorskip("PIL.Image")
    file = io.BytesIO()
    pil.new("RGB", size).save(file, kind)
    assert picture_size(file.getvalue()) == size


@pytest.mark.parametrize("data", [b"", b"GIF89a", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff\xe0"])
def test_of_none(data: bytes) -> None:
    assert picture_size(data) is None


@given(st.sampled_from([b"", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"]), st.binary(max_size=60))
def test_never_raises(start: bytes, rest: bytes) -> None:
    picture_size(start + rest)
