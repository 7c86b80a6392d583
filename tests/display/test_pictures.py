"""Pictures without a 3D viewer: what they show, what is left out, and where nothing can draw."""

from __future__ import annotations

import io
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace
from PIL import Image

from checker.base.cache import Cache
from checker.base.sandbox.launcher import OwnLauncher
from checker.model.geometry.transform import Transform
from checker.physics.mesh.surface import Surface
from checker.report.report import Picture
from checker.report.scene.drawing.request import FIELD_OF_VIEW, camera_framing, drawn_items
from checker.report.scene.drawing.worker import LARGEST
from checker.report.scene.pictures import ASPECT, HEIGHT, MOMENTS, WIDTH, Drawing, shots_of
from checker.report.scene.scene import DisplayScene, Item, Layer, LinkNode, Tracks
from tests.mesh.files import box

RED = (0.9, 0.1, 0.1, 1.0)


def surface(colour: tuple[float, float, float, float] = RED, **more: Any) -> Surface:
    """Return a cube of 1 m."""
    corners = np.array(box(1, 1, 1), np.float32).reshape(-1, 3)
    return Surface(corners, np.arange(36, dtype=np.uint32).reshape(-1, 3), colour, **more)


def scene(*surfaces: Surface, tracks: Tracks | None = None, scale: float = 1.0) -> DisplayScene:
    """Return a robot of one link, 1 m above the ground, with a collision as large as its visual."""
    items = tuple(
        Item(layer, "part", "sdf/model", Transform(), surfaces, (scale, 1.0, 1.0))
        for layer in (Layer.VISUAL, Layer.COLLISION)
    )
    return DisplayScene("robot", (LinkNode("base", "sdf/model", Transform(), items),), tracks)


def driving(metres: float, samples: int = 20) -> Tracks:
    poses = np.zeros((samples, 7), np.float32)
    poses[:, 0], poses[:, 2], poses[:, 3] = np.linspace(0, metres, samples), 0.5, 1.0
    return Tracks(np.arange(samples, dtype=np.float32) / 10, {"base": poses})


def pixels(picture: Picture) -> Any:
    image = Image.open(io.BytesIO(picture.jpeg), formats=("JPEG",))
    assert image.size == (picture.width, picture.height) == (WIDTH, HEIGHT)
    return np.asarray(image.convert("RGB"), np.int64)


def red(picture: Picture) -> Any:
    """Return whether each pixel is one of the robot's."""
    seen = pixels(picture)
    return (seen[..., 0] > 90) & (seen[..., 1] < 80) & (seen[..., 2] < 80)


def pictures_of(shown: DisplayScene) -> tuple[Picture, ...]:
    drawing = Drawing()
    try:
        drawing.give(shown, tuple(shots_of(shown, ASPECT)))
        return drawing.pictures
    finally:
        drawing.stop()


def drawn(shown: DisplayScene) -> tuple[Picture, ...]:
    found = pictures_of(shown)
    if not found:
        pytest.skip("nothing here draws without a window: no EGL, no OSMesa")
    return found


@pytest.mark.programs
def test_pictures_show_the_robot_its_shapes_and_its_trial() -> None:
    found = drawn(scene(surface(), tracks=driving(5.0)))
    assert len(found) == 2 + MOMENTS
    assert found[0].caption == "The robot, from its front left"
    assert found[2].caption == "The trial after 0.0 s; tiles are 1 m long"
    for picture in found:
        assert len(picture.jpeg) <= LARGEST
        assert pixels(picture).std() > 5.0
    assert 0.15 < red(found[0]).mean() < 0.6
    moments = [red(picture) for picture in found[2:]]
    middles = [np.argwhere(moment).mean(axis=0) for moment in moments]
    for moment in moments:
        assert 0.003 < moment.mean() < 0.2
        # Whole, with something around it.
        assert not moment[[0, -1]].any()
        assert not moment[:, [0, -1]].any()
    for one, other in ((0, 1), (1, 2), (0, 2)):
        assert np.linalg.norm(middles[one] - middles[other]) > 50.0


@pytest.mark.programs
@pytest.mark.parametrize(
    "more",
    [
        pytest.param(Surface(np.zeros((3, 3)), np.array([[0, 1, 2]])), id="no area"),
        pytest.param(Surface(np.eye(3), np.array([[0, 1, 2]])), id="one triangle"),
        pytest.param(
            Surface(
                np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]), np.array([[0, 1, 2]])
            ),
            id="flat",
        ),
        pytest.param(Surface(np.eye(3) * 1e-9, np.array([[0, 1, 2]])), id="tiny"),
        pytest.param(Surface(np.zeros((0, 3)), np.zeros((0, 3), np.uint32)), id="nothing"),
        pytest.param(
            Surface(np.eye(4)[:, :3] * 1e20, np.array([[0, 1, 2], [0, 1, 3]])), id="far away"
        ),
    ],
)
def test_odd_surfaces_do_not_keep_the_others_from_the_picture(more: Surface) -> None:
    shown = scene(surface())
    odd = Item(Layer.VISUAL, "odd", "sdf/model", Transform(), (more,))
    link = LinkNode("odd", "sdf/model", Transform(), (odd,))
    found = drawn(DisplayScene("robot", (*shown.links, link)))
    assert red(found[0]).mean() > 0.05


@pytest.mark.programs
def test_mirrored_shapes_have_their_outer_sides_outside() -> None:
    plain, mirrored = drawn(scene(surface())), drawn(scene(surface(), scale=-1.0))
    for one, other in zip(plain, mirrored, strict=True):
        assert np.abs(pixels(one) - pixels(other)).mean() < 1.0


@pytest.mark.programs
def test_colours_of_corners_are_seen() -> None:
    painted = np.tile(np.array([20, 200, 30, 255], np.uint8), (36, 1))
    white = (1.0, 1.0, 1.0, 1.0)
    found = pixels(drawn(scene(surface(white, vertex_colours=painted)))[0])
    assert ((found[..., 1] > 90) & (found[..., 0] < 80)).mean() > 0.15


def test_what_stands_still_has_no_moments() -> None:
    assert len(list(shots_of(scene(surface(), tracks=driving(0.0)), 4 / 3))) == 2
    assert len(list(shots_of(scene(surface(), tracks=driving(5.0)), 4 / 3))) == 2 + MOMENTS


def test_of_nothing_there_are_no_pictures() -> None:
    assert pictures_of(DisplayScene("robot", ())) == ()
    assert pictures_of(scene(Surface(np.eye(3) * np.nan, np.array([[0, 1, 2]])))) == ()


def test_without_opengl_there_are_no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere")
    monkeypatch.setenv("LIBGL_DRIVERS_PATH", "/nowhere")
    monkeypatch.setattr("checker.report.scene.pictures.PLATFORMS", ("egl",))
    # One that started before knows the variables of before.
    with closing(OwnLauncher()) as launcher:
        monkeypatch.setattr("checker.base.child_process.launcher", lambda: launcher)
        assert pictures_of(scene(surface())) == ()


@pytest.mark.programs
def test_a_drawing_may_begin_before_it_is_known_what_to_draw() -> None:
    drawing = Drawing()
    try:
        assert drawing.pictures == ()
        drawing.begin()
        assert drawing.pictures == ()
        shown = scene(surface())
        drawing.give(shown, tuple(shots_of(shown, ASPECT)))
        early = drawing.pictures
    finally:
        drawing.stop()
    assert [each.jpeg for each in early] == [each.jpeg for each in pictures_of(scene(surface()))]


@pytest.mark.programs
def test_what_was_drawn_once_is_not_drawn_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def pictures(shown: DisplayScene) -> tuple[Picture, ...]:
        drawing = Drawing(Cache(tmp_path))
        try:
            drawing.give(shown, tuple(shots_of(shown, ASPECT)))
            return drawing.pictures
        finally:
            drawing.stop()

    found = pictures(scene(surface()))
    if not found:
        pytest.skip("nothing here draws without a window: no EGL, no OSMesa")
    monkeypatch.setattr("checker.report.scene.pictures.PLATFORMS", ("nothing",))
    assert pictures(scene(surface())) == found
    assert pictures(scene(surface((0.1, 0.9, 0.1, 1.0)))) == ()
    for entry in tmp_path.rglob("*.json"):
        entry.write_text('["no JPEG"]')
    assert pictures(scene(surface())) == ()


POINT = st.tuples(*(st.floats(-1e3, 1e3, width=32) for _ in range(3)))


@given(st.lists(POINT, min_size=1, max_size=20), st.floats(-360, 360), st.floats(-80, 80))
def test_a_camera_sees_all_that_it_frames(
    points: Sequence[tuple[float, float, float]], azimuth: float, elevation: float
) -> None:
    camera = camera_framing(np.array(points), azimuth, elevation, 4 / 3)
    turn, rise = np.radians(azimuth), np.radians(elevation)
    forward = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([np.sin(turn), -np.cos(turn), 0.0])
    away = np.array(points) - np.array(camera.lookat) + forward * camera.distance
    depth = away @ forward
    half = np.tan(np.radians(FIELD_OF_VIEW / 2))
    assert (depth > 0.0).all()
    assert (np.abs(away @ right) <= depth * half * 4 / 3 + 1e-6).all()
    assert (np.abs(away @ np.cross(right, forward)) <= depth * half + 1e-6).all()


def test_what_draws_has_few_enough_triangles() -> None:
    """A mesh of as many triangles that is shown 300 times took 2.5 GB."""
    fine = Surface(np.zeros((3, 3), np.float32) + 1.0, np.tile(np.uint32([0, 1, 2]), (39_000, 1)))
    one = scene(surface()).links[0].items[0]
    items = (*(replace(one, surfaces=(fine,)) for _ in range(300)), one)
    shown = list(drawn_items(DisplayScene("robot", (LinkNode("b", "m", Transform(), items),))))
    assert sum(len(part.faces) for _, item in shown for part in item.surfaces) <= 1_000_000
    assert shown[-1][1] is one
