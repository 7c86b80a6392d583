"""What is drawn, and what is said where nothing can be."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from checker.base.cache import NO_CACHE
from checker.engine.subject import Subject
from checker.migrate.thumbnails import Thumbnails, thumbnails_of
from checker.model.robot import Robot
from checker.package.inputs import open_input

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
ROBOT = """<sdf version="1.6"><model name="m"><link name="l">{}</link></model></sdf>"""
VISUAL = """<visual name="v"><geometry><mesh><uri>a.obj</uri></mesh></geometry>
<material><diffuse>1 0 0 1</diffuse></material></visual>"""


def drawn(folder: Path, mesh: str, visual: str = VISUAL) -> Thumbnails:
    (folder / "a.obj").write_text(mesh, "utf-8")
    (folder / "model.sdf").write_text(ROBOT.format(visual), "utf-8")
    with open_input(folder) as opened:
        subject = Subject(opened.packages[0], NO_CACHE)
        try:
            robot = subject.one(Robot)
            assert isinstance(robot, Robot)
            return thumbnails_of(robot)
        finally:
            subject.close()


@pytest.mark.parametrize(
    ("mesh", "visual", "said"),
    [
        ("no mesh", VISUAL, "a.obj"),
        (TETRAHEDRON, VISUAL.replace("a.obj", "b.obj"), "b.obj"),
        (TETRAHEDRON, "", "the model has no visuals"),
    ],
)
def test_what_cannot_be_drawn_is_named(tmp_path: Path, mesh: str, visual: str, said: str) -> None:
    pictures = drawn(tmp_path, mesh, visual)
    assert pictures.files == {}
    assert pictures.trouble.startswith("thumbnails/1.png to 5.png ")
    assert said in pictures.trouble


@pytest.mark.programs
def test_a_robot_is_drawn_from_five_sides(tmp_path: Path) -> None:
    pictures = drawn(tmp_path, TETRAHEDRON)
    if "the process that draws" in pictures.trouble:
        pytest.skip(pictures.trouble)
    assert (pictures.trouble, [*pictures.files]) == ("", ["1", "2", "3", "4", "5"])
    seen = [
        np.asarray(Image.open(io.BytesIO(file), formats=("PNG",)), np.int64)
        for file in pictures.files.values()
    ]
    for pixels in seen:
        red = (pixels[..., 0] > 90) & (pixels[..., 1] < 80)
        assert 0.05 < red.mean() < 0.6
    assert len({pixels.tobytes() for pixels in seen}) == 5
