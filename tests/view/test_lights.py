"""How much of what a light shines at a mesh takes, and which lights are asked about."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from checker.base.cache import NO_CACHE
from checker.engine.subject import Subject
from checker.model.sensing.view import SensorViews
from checker.package.inputs import open_input
from checker.physics.views.lights import covered_shares
from checker.rule_testing import write_example
from tests.mesh.files import binary_stl, box

CUBE = np.array(box(1.0, 1.0, 1.0), float)
APART = binary_stl([*box(0.2, 1.0, 1.0, (0.4, 0, 0)), *box(0.2, 1.0, 1.0, (-0.4, 0, 0))])
"""Two walls: together no convex mesh."""


def lamp(at: tuple[float, float, float], along: tuple[float, float, float]) -> dict[str, object]:
    return {"at": at, "along": along, "half": 0.3}


class TestCovered:
    def test_a_light_in_a_closed_mesh_shines_at_nothing_else(self) -> None:
        assert covered_shares(CUBE, {"at": (0.1, 0.2, 0.0)}) == pytest.approx((1.0, 1.0), abs=0.01)

    def test_which_way_triangles_face_does_not_matter(self) -> None:
        inside_out = CUBE[:, ::-1]
        assert covered_shares(inside_out, {"at": (0, 0, 0)}) == pytest.approx((1.0, 1.0), abs=0.01)

    def test_a_light_beside_a_wall_has_half_of_its_surroundings(self) -> None:
        around, ahead = covered_shares(CUBE, {"at": (0.5001, 0.0, 0.0)})
        assert around == pytest.approx(0.5, abs=0.05)
        assert ahead == around

    @pytest.mark.parametrize(
        ("along", "share"), [((-1, 0, 0), 1.0), ((1, 0, 0), 0.0), ((0, 0, -1), 0.0)]
    )
    def test_a_beam_meets_what_is_ahead(
        self, along: tuple[float, float, float], share: float
    ) -> None:
        _, ahead = covered_shares(CUBE, lamp((0.7, 0.0, 0.0), along))
        assert ahead == share


def views(light: str, folder: Path, mesh: bytes = APART, more: str = "") -> SensorViews:
    visual = f"""<visual name="v">{more}
<geometry><mesh><uri>meshes/a.stl</uri></mesh></geometry></visual>"""
    example = {"@fragment": visual + light, "meshes/a.stl": mesh}
    with open_input(write_example(example, folder)) as opened:
        subject = Subject(opened.packages[0], NO_CACHE)
        try:
            found = subject.all(SensorViews)
            assert isinstance(found, tuple)
            return found[0]
        finally:
            subject.close()


SPOT = """<light name="lamp" type="spot"><cast_shadows>1</cast_shadows><direction>1 0 0</direction>
<spot><outer_angle>0.8</outer_angle></spot></light>"""


def test_a_robot_without_sensors_has_its_lights_looked_at(tmp_path: Path) -> None:
    found = views(SPOT, tmp_path)
    (at,) = found.covered
    assert (at.light.name.value, at.visual.name.value) == ("lamp", "v")
    assert at.ahead == 1.0
    assert 0.3 < at.around < 0.9
    assert (found.views, found.unseen) == ((), ())


@pytest.mark.parametrize(
    ("light", "mesh", "more"),
    [
        (SPOT.replace(">1<", ">0<"), APART, ""),
        (SPOT.replace("spot", "directional"), APART, ""),
        (SPOT.replace("<spot>", "<pose>2 0 0 0 0 0</pose><spot>"), APART, ""),
        (SPOT, binary_stl(box(1.0, 1.0, 1.0)), ""),
        (SPOT, APART, "<transparency>0.5</transparency>"),
        (SPOT, b"", ""),
    ],
)
def test_no_other_lights_are_asked_about(
    light: str, mesh: bytes, more: str, tmp_path: Path
) -> None:
    assert views(light, tmp_path, mesh, more).covered == ()
