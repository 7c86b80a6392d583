"""Stages: said when they begin, and timed without what goes on inside them."""

from __future__ import annotations

from time import sleep

from checker.base.progress import Stages
from checker.model.mesh import Mesh
from checker.physics.mesh.package_meshes import TimedMeshes
from checker.source.text import Located, SourceText


def test_a_stage_is_said_and_timed() -> None:
    said: list[str] = []
    stages = Stages(said.append)
    with stages.stage("rules", "rules"), stages.stage("weigh"):
        pass
    assert said == ["rules"]
    assert set(stages.seconds) == {"rules", "weigh"}


def test_the_time_of_a_stage_inside_another_counts_once() -> None:
    stages = Stages()
    with stages.stage("outer"), stages.stage("inner"):
        sleep(0.05)
    with stages.stage("inner"):
        sleep(0.05)
    assert stages.seconds["inner"] >= 0.1 > stages.seconds["outer"]


def test_a_stage_that_fails_is_timed_all_the_same() -> None:
    stages = Stages()
    try:
        with stages.stage("rules"):
            raise ValueError
    except ValueError:
        pass
    assert "rules" in stages.seconds


class Meshes:
    def of(self, uri: Located[str]) -> Mesh:
        return Mesh(uri.value, "stl", 12, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))


def test_the_first_mesh_stands_for_the_reading_of_all() -> None:
    said: list[str] = []
    meshes = TimedMeshes(Meshes(), 2, Stages(said.append))
    assert not meshes.read
    for name in ("a.stl", "b.stl"):
        mesh = meshes.of(Located(name, SourceText("model.sdf", name).whole()))
        assert isinstance(mesh, Mesh)
        assert mesh.path == name
    assert meshes.read
    assert said == ["reading 2 meshes"]
