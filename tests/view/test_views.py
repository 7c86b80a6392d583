"""The views of a robot's sensors: visuals of all kinds, files, the cache, and what goes wrong."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.base.cache import NO_CACHE, Cache
from checker.engine.subject import Subject
from checker.model.sensing.view import SensorViews
from checker.package.inputs import open_input
from checker.physics.mesh import process
from checker.rule_testing import write_example
from tests.mesh.files import binary_stl, box, dae

PLATE = binary_stl(box(0.02, 1.0, 1.0))
CAMERA = """
<sensor name="front" type="camera">
  <camera><horizontal_fov>1</horizontal_fov><clip><near>0.01</near></clip></camera>
</sensor>
"""


def mesh(uri: str, pose: str = "0.05 0 0 0 0 0", more: str = "") -> str:
    return (
        f'<visual name="{uri}"><pose>{pose}</pose>'
        f"<geometry><mesh><uri>{uri}</uri>{more}</mesh></geometry></visual>"
    )


def views(
    visuals: str, folder: Path, files: Mapping[str, str | bytes] = {}, cache: Cache = NO_CACHE
) -> SensorViews:
    changes = {"@fragment": f'<link name="a">{visuals}{CAMERA}</link>', **files}
    with open_input(write_example(changes, folder)) as opened:
        subject = Subject(opened.packages[0], cache)
        try:
            found = subject.all(SensorViews)
            assert isinstance(found, tuple)
            return found[0]
        finally:
            subject.close()


def solid(text: str, pose: str = "0.05 0 0 0 0 0") -> str:
    return f'<visual name="v"><pose>{pose}</pose><geometry>{text}</geometry></visual>'


@pytest.mark.parametrize(
    "visual",
    [
        solid("<box><size>0.02 1 1</size></box>"),
        solid("<box><size>1 0.02 1</size></box>", "0.05 0 0 0 0 1.5708"),
        solid("<cylinder><radius>1</radius><length>0.02</length></cylinder>", "0.05 0 0 0 1.57 0"),
        solid("<sphere><radius>1</radius></sphere>", "1.05 0 0 0 0 0"),
    ],
)
def test_a_wall_before_the_lens_fills_the_view(visual: str, tmp_path: Path) -> None:
    (view,) = views(visual, tmp_path).views
    assert view.hidden_share == pytest.approx(1.0, abs=1e-3)
    assert view.hidden_share_within(0.03) == 0.0
    assert view.hidden_share_within(1.0) == pytest.approx(1.0, abs=1e-3)
    assert view.cut == 0.0
    assert view.by is not None


def test_half_a_wall_fills_half_the_view(tmp_path: Path) -> None:
    half = solid("<box><size>0.02 2 2</size></box>", "0.05 1 0 0 0 0")
    (view,) = views(half, tmp_path).views
    assert view.hidden_share == pytest.approx(0.5, abs=0.01)


def test_what_is_nearer_than_the_near_clip_is_cut(tmp_path: Path) -> None:
    (view,) = views(solid("<box><size>0.01 1 1</size></box>", "0.01 0 0 0 0 0"), tmp_path).views
    assert view.hidden_share == 0.0
    assert view.cut == pytest.approx(1.0, abs=1e-3)


def test_a_mesh_is_as_good_as_a_box_with_scale_and_pose(tmp_path: Path) -> None:
    turned = mesh("meshes/a.stl", "0.05 0 0 3.1416 0 0", "<scale>0.5 2 2</scale>")
    (view,) = views(turned, tmp_path, {"meshes/a.stl": PLATE}).views
    assert view.hidden_share == pytest.approx(1.0, abs=1e-3)
    assert view.filled[0].metres == pytest.approx(0.045, rel=0.3)


def test_without_sensors_or_visuals_nothing_is_asked(tmp_path: Path) -> None:
    found = views("", tmp_path)
    assert [view.hidden_share for view in found.views] == [0.0]
    assert not found.unseen


def test_an_answer_is_kept_and_holds_while_nothing_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache, files = Cache(tmp_path / "cache"), {"meshes/a.stl": PLATE}
    one = views(mesh("meshes/a.stl"), tmp_path / "one", files, cache)
    monkeypatch.setattr("checker.base.child_server._Process", None)
    same = views(mesh("meshes/a.stl"), tmp_path / "two", files, cache)
    rays = [
        [(hit.share, hit.metres, hit.azimuth) for view in found.views for hit in view.filled]
        for found in (one, same)
    ]
    assert rays[0]
    assert rays[0] == rays[1]
    with pytest.raises(TypeError):
        views(mesh("meshes/a.stl", "0.1 0 0 0 0 0"), tmp_path / "three", files, cache)


@pytest.mark.parametrize(
    ("visual", "content", "reason"),
    [
        (mesh("meshes/b.stl"), PLATE, "meshes/b.stl does not exist"),
        (mesh("meshes/a.stl"), PLATE[:-200], "meshes/a.stl is cut off"),
        (mesh("meshes/a.stl"), b"", "meshes/a.stl is empty"),
        (
            mesh("meshes/a.stl", more="<submesh><name>lid</name></submesh>"),
            PLATE,
            "meshes/a.stl is only partly used (<submesh>)",
        ),
        (solid("<polyline/>"), PLATE, "a visual of kind polyline is not checked"),
    ],
)
def test_what_cannot_be_looked_at_is_said(
    visual: str, content: bytes, reason: str, tmp_path: Path
) -> None:
    cache = Cache(tmp_path / "cache")
    found = views(visual, tmp_path / "package", {"meshes/a.stl": content}, cache)
    assert found.unseen[0].startswith(reason)
    assert [view.hidden_share for view in found.views] == [0.0]
    # A report that says so can be remembered: the file is at fault, and stays so.
    assert cache.is_whole


def test_what_the_reader_gave_up_is_tried_again(tmp_path: Path) -> None:
    cache, files = Cache(tmp_path / "cache"), {"meshes/a.dae": "<!DOCTYPE COLLADA><COLLADA/>"}
    found = views(mesh("meshes/a.dae"), tmp_path / "package", files, cache)
    assert "<!DOCTYPE>" in found.unseen[0]
    assert not cache.is_whole


def test_a_part_that_is_centred_stands_at_the_origin(tmp_path: Path) -> None:
    plate = dae(box(0.02, 1.0, 1.0), node="<translate>-5 0 0</translate>")
    pick = "<submesh><name>body</name><center>{}</center></submesh>"
    hidden = [
        views(mesh("a.dae", more=pick.format(center)), tmp_path / center, {"a.dae": plate})
        for center in ("false", "true")
    ]
    assert [found.views[0].hidden_share for found in hidden] == pytest.approx([0.0, 1.0], abs=0.01)
    assert [found.unseen for found in hidden] == [(), ()]


@pytest.mark.parametrize(
    "size", ["0.02 inf 1", "0.02 -1 1", "nan 1 1", "0 0 0", "1e300 1e300 1e300", "word", "1"]
)
@pytest.mark.parametrize("pose", ["0.05 0 0 0 0 0", "1e300 0 0 0 0 0"])
def test_lengths_of_any_kind_do_no_harm(size: str, pose: str, tmp_path: Path) -> None:
    found = views(solid(f"<box><size>{size}</size></box>", pose), tmp_path)
    assert len(found.views) == 1


def test_a_child_that_fails_leaves_a_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(process, "MEMORY", 1_000_000)
    found = views(mesh("meshes/a.stl"), tmp_path, {"meshes/a.stl": PLATE})
    assert not found.views
    assert found.unseen[0].startswith("the views of the sensors were not computed")
