"""A folder that lends meshes to the models beside it."""

from __future__ import annotations

from pathlib import Path

from checker.pipeline import check_package
from checker.settings import Settings

CONFIG = """<?xml version="1.0"?>
<model><name>common</name><version>1.0</version></model>
"""


def test_its_meshes_are_not_called_unused(tmp_path: Path) -> None:
    meshes = tmp_path / "common" / "meshes"
    meshes.mkdir(parents=True)
    (meshes / "wheel.dae").write_text("<COLLADA/>")
    (meshes.parent / "model.config").write_text(CONFIG)
    (checked,) = check_package(meshes.parent, Settings(trial=False)).packages
    assert "REF005" not in {finding.rule for finding in checked.findings}
    assert checked.profile == "gazebo-harmonic"
