"""Reports that hold the robot in 3D, when somebody asks for it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from checker.engine import display
from checker.engine.display import BYTES, display_of
from checker.physics.mesh.surface import Surface
from checker.pipeline import check_package
from checker.report.report import Cause, PackageReport
from checker.report.scene.scene import Layer
from checker.settings import Settings
from checker.source.text import Located
from tests.conftest import SAMPLES
from tests.display.glb_reader import read_glb
from tests.model.robots import sdf

BALL = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'


def report_of(folder: Path, **wanted: bool) -> PackageReport:
    (package,) = check_package(folder, Settings(cache=False, **wanted)).packages
    return package


@pytest.mark.slow
def test_only_who_asks_gets_the_robot_in_3d() -> None:
    folder = SAMPLES / "my_gurdy_description"
    assert report_of(folder, trial=False).display is None
    shown = report_of(folder, display=True)
    assert shown.display is not None
    assert "display" in shown.timings
    glb = read_glb(shown.display.glb)
    assert [each["name"] for each in glb.said["animations"]] == ["trial"]


@pytest.mark.slow
def test_without_a_trial_nothing_moves() -> None:
    shown = report_of(SAMPLES / "my_gurdy_description", display=True, trial=False)
    assert shown.display is not None
    assert "animations" not in read_glb(shown.display.glb).said


@pytest.mark.slow
def test_a_fault_of_ours_is_no_fault_of_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise RuntimeError("no paint")

    monkeypatch.setattr(display, "display_of", broken)
    report = report_of(SAMPLES / "my_gurdy_description", display=True)
    (crashed,) = (each for each in report.not_checked if each.cause is Cause.CRASHED)
    assert crashed.rule == "display"
    assert report.display is None
    assert report.trial is not None


class Large:
    """Mesh files of four megabytes each."""

    def load(self, uri: Located[str]) -> tuple[Surface, ...]:
        vertices = np.zeros((330_000, 3), dtype=np.float32)
        vertices[:, 0] = len(uri.value)
        return (Surface(vertices, np.array([[0, 1, 2]], dtype=np.uint32)),)


def test_layers_that_take_too_much_room_are_left_out() -> None:
    shapes = "".join(
        f'<{kind} name="v"><geometry><mesh><uri>{kind}.dae</uri></mesh></geometry></{kind}>'
        for kind in ("visual", "collision")
    )
    display = display_of(sdf(f'<link name="a">{shapes}</link>'), None, Large())
    assert display is not None
    assert len(display.glb) <= BYTES
    assert display.notes == ("the layer collision is not shown: it is too large",)
    glb = read_glb(display.glb)
    assert glb.find(layer=str(Layer.VISUAL))
    assert not glb.find(layer=str(Layer.COLLISION))
