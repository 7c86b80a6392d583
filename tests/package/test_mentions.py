"""A mesh or picture is used when any file of the package names it."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.mentions import mentioned_names
from checker.package.package import Package
from checker.package.workspace import Workspace


def names_in(folder: Path, text: bytes, file: str = "model.sdf") -> frozenset[str]:
    package = folder / "rover"
    package.mkdir()
    (package / file).write_bytes(text)
    return mentioned_names(Package(package, Workspace((folder,))))


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (b"<uri>meshes/wheel.dae</uri>", "wheel.dae"),
        (b"<uri>model://rover/meshes/Wheel.DAE</uri>", "wheel.dae"),
        (b"<uri>meshes/wheel%20rim.dae</uri>", "wheel rim.dae"),
        (b"<uri>meshes/wheel rim.dae</uri>", "wheel rim.dae"),
        (b"map_Kd paint.png\n", "paint.png"),
        (b"textures\\paint.png", "paint.png"),
        ("<uri>räder.stl</uri>".encode(), "räder.stl"),
        (b"\x00\x04Texture0\x00paint.jpg\x00\xff", "paint.jpg"),
    ],
)
def test_a_name_is_found(tmp_path: Path, text: bytes, name: str) -> None:
    assert name in names_in(tmp_path, text)


@pytest.mark.parametrize("text", [b"wheel.daemon", b"wheel.png.bak", b"wheel", b"1.5 2.5"])
def test_what_only_looks_like_a_name_is_none(tmp_path: Path, text: bytes) -> None:
    assert not names_in(tmp_path, text)


def test_a_picture_names_nothing(tmp_path: Path) -> None:
    assert not names_in(tmp_path, b"wheel.dae", file="paint.png")


def test_many_mentions_take_little_time(tmp_path: Path) -> None:
    assert ".png" in names_in(tmp_path, b".png " * 1_000_000)
