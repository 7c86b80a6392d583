"""What is drawn, and what is said where nothing can be."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from checker.base.child_process import Limits, ask
from checker.migrate.assets import thumbnails_of
from checker.model.sdf.reader import read_sdf
from tests.model.robots import document

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
FLAT = "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\nf 1 3 4\n"
ROBOT = """<sdf version="1.6"><model name="m"><link name="l"><visual name="v"><geometry>
<mesh><uri>a.obj</uri></mesh></geometry></visual></link></model></sdf>"""
LIMITS = Limits(60.0, 16_000_000_000, draws=True)
NO_OPENGL = "OpenGL is not available (EGL or OSMesa)"


def request_of(folder: Path, mesh: str) -> bytes:
    (folder / "a.obj").write_text(mesh, "utf-8")
    shape = {
        "shape": "mesh",
        "sizes": {},
        "file": str(folder / "a.obj"),
        "position": [0, 0, 0],
        "quaternion": [1, 0, 0, 0],
        "colour": [1, 1, 1, 1],
    }
    return json.dumps({"shapes": [shape]}).encode()


@pytest.mark.parametrize(
    ("mesh", "said"),
    [
        ("no mesh", "no mesh of the robot can be read"),
        (TRIANGLE, "no mesh of the robot can be read"),
        (FLAT, "MuJoCo refuses the shapes"),
    ],
)
def test_a_mesh_that_cannot_be_drawn_is_not_a_lack_of_opengl(
    tmp_path: Path, mesh: str, said: str
) -> None:
    request, path = request_of(tmp_path, mesh), str(tmp_path / "a.obj")
    drawn = ask("checker.migrate.thumbnail_worker", request, LIMITS, [(path, mesh.encode())])
    assert isinstance(drawn, bytes)
    unable = json.loads(drawn)["unable"]
    assert said in unable or unable == NO_OPENGL


@pytest.mark.programs
def test_a_robot_of_a_mesh_is_drawn_from_a_relative_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.obj").write_text(TETRAHEDRON, "utf-8")
    monkeypatch.chdir(tmp_path)
    (robot,) = read_sdf(document(ROBOT))
    drawn = thumbnails_of(robot, Path(os.curdir))
    if NO_OPENGL in drawn.trouble:
        pytest.skip(NO_OPENGL)
    assert (drawn.trouble, len(drawn.files)) == ("", 5)
