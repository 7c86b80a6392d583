"""Colours of parts in files that trimesh reads, and errors of its own."""

from __future__ import annotations

from typing import Any

import pytest

from checker.model.mesh import MeshFault, MeshTrouble
from checker.physics.mesh import reader
from checker.physics.mesh.reader import read_content, read_mesh
from checker.physics.mesh.surface import GREY


def glb(**material: Any) -> bytes:
    """Return a box with texture coordinates and a material without a picture."""
    import trimesh

    box = trimesh.creation.box()
    look = trimesh.visual.material.PBRMaterial(**material)
    box.visual = trimesh.visual.TextureVisuals([(0.0, 0.0)] * len(box.vertices), look)
    written = trimesh.Scene(box).export(file_type="glb")
    assert isinstance(written, bytes)
    return written


def test_a_base_colour_without_a_picture() -> None:
    (piece,) = read_content(glb(baseColorFactor=[255, 51, 0, 255]), "a.glb").pieces
    assert piece.material.colour == pytest.approx((1.0, 0.2, 0.0, 1.0))
    assert len(piece.corners) == 12


def test_texture_coordinates_without_a_colour() -> None:
    (piece,) = read_content(glb(), "a.glb").pieces
    assert piece.material.colour == pytest.approx((0.4, 0.4, 0.4, 1.0)) != GREY


def test_an_error_of_the_reader_does_not_show_a_corrupt_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(*_: object) -> None:
        raise TypeError("'int' object is not iterable")

    monkeypatch.setitem(reader._READERS, "glb", fail)
    read = read_mesh(b"glTF", "a.glb")
    assert isinstance(read, MeshFault)
    assert read.trouble is MeshTrouble.NOT_LOOKED_AT
    assert read.reason == "is not read: its reader failed (TypeError: 'int' object is not iterable)"
