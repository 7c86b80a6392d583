"""Stages: said when they begin, and timed without what goes on inside them."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.output import Stages
from checker.engine.subject import Subject
from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.rule_testing import write_example
from tests.mesh.files import binary_stl, box


def test_a_stage_is_said_and_timed() -> None:
    said: list[str] = []
    stages = Stages(said.append)
    with stages.stage("rules", "rules"), stages.stage("weigh"):
        pass
    assert said == ["rules"]
    assert set(stages.seconds) == {"rules", "weigh"}


def test_the_time_of_a_stage_inside_another_counts_once(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [5.0]
    monkeypatch.setattr("checker.base.output.perf_counter", lambda: now[0])
    stages = Stages()
    with stages.stage("outer"):
        now[0] += 1.0
        with stages.stage("inner"):
            now[0] += 10.0
    with stages.stage("inner"):
        now[0] += 100.0
    assert stages.seconds == {"inner": 110.0, "outer": 1.0}


def test_a_stage_that_fails_is_timed_all_the_same() -> None:
    stages = Stages()
    try:
        with stages.stage("rules"):
            raise ValueError
    except ValueError:
        pass
    assert "rules" in stages.seconds


def test_the_first_mesh_stands_for_the_reading_of_all(tmp_path: Path) -> None:
    said: list[str] = []
    shapes = "".join(
        f'<visual name="{n}"><geometry><mesh><uri>{n}.stl</uri></mesh></geometry></visual>'
        for n in "ab"
    )
    files = {"a.stl": binary_stl(box(1, 1, 1)), "b.stl": binary_stl(box(1, 1, 2))}
    example = {"@fragment": f'<link name="a">{shapes}</link>', **files}
    with open_input(write_example(example, tmp_path)) as opened:
        subject = Subject(opened.packages[0], stages=Stages(said.append))
        robots = subject.all(Robot)
        assert isinstance(robots, tuple)
        meshes = robots[0].meshes
        assert isinstance(meshes, PackageMeshes)
        assert not meshes.read
        for uri, name in zip(meshes.uris, files, strict=True):
            mesh = meshes.load(uri)
            assert isinstance(mesh, Mesh)
            assert mesh.path == name
        assert meshes.read
        subject.close()
    assert said == ["reading 2 meshes"]
