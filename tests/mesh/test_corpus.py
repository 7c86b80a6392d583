"""Every mesh of the real packages reads."""

from __future__ import annotations

from pathlib import Path

from checker.model.mesh import Mesh
from checker.physics.mesh.reader import read_mesh


def test_every_mesh_of_the_corpus_reads(corpus: Path) -> None:
    files = [f for f in corpus.rglob("*") if f.suffix.lower() in (".dae", ".stl", ".obj")]
    assert len(files) == 129
    for file in files:
        data = file.read_bytes()
        read = read_mesh(data, file.name)
        assert isinstance(read, Mesh), f"{file}: {read}"
        assert read.hull_volume > 0
        assert any("<STL_BINARY>" in defect for defect in read.defects) is (
            b'"<STL_BINARY>' in data
        ), file
        assert len(read.defects) <= 1
