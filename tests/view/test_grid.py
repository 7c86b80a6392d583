"""The rays that stand for a sensor's view."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec import convert, to_builtins

from checker.physics.views.rays import Grid, Steps, grid_of
from tests.model.robots import sdf


def grid(sensor: str) -> Grid | None:
    return grid_of(sdf(f'<link name="a">{sensor}</link>').sensors[0])


def camera(angle: float, width: float = 640, height: float = 480, near: float = 0.1) -> Grid | None:
    return grid(
        f'<sensor name="s" type="camera"><camera><horizontal_fov>{angle}</horizontal_fov>'
        f"<image><width>{width}</width><height>{height}</height></image>"
        f"<clip><near>{near}</near><far>50</far></clip></camera></sensor>"
    )


def lidar(across: str, up: str = "", range_: str = "<min>0.1</min><max>100</max>") -> Grid | None:
    return grid(
        '<sensor name="s" type="gpu_lidar"><lidar><scan>'
        f"<horizontal>{across}</horizontal>{up}</scan><range>{range_}</range></lidar></sensor>"
    )


@given(
    st.floats(0.05, 2 * math.pi),
    st.floats(1, 4000),
    st.floats(1, 4000),
)
def test_rays_of_a_camera_are_unit_vectors_that_share_the_whole_view(
    angle: float, width: float, height: float
) -> None:
    rays = camera(angle, width, height)
    assert rays is not None
    assert np.allclose(np.linalg.norm(rays.directions, axis=1), 1.0)
    assert (rays.weights >= 0.0).all()
    assert rays.weights.sum() == pytest.approx(1.0)


@pytest.mark.parametrize("angle", [0.6, 1.2, 2.0])
def test_weights_of_a_camera_are_those_of_its_pixels(angle: float) -> None:
    rays = camera(angle)
    assert rays is not None
    x, y, z = rays.directions.T
    right_quarter = y < -0.5 * math.tan(angle / 2) * x
    upper_half = z > 0.0
    assert rays.weights[right_quarter].sum() == pytest.approx(0.25, abs=0.04)
    assert rays.weights[upper_half].sum() == pytest.approx(0.5, abs=1e-9)


def test_a_camera_measures_its_near_clip_along_its_axis() -> None:
    rays = camera(1.5, near=0.2)
    assert rays is not None
    ahead = rays.near_along * rays.directions[:, 0]
    assert np.allclose(ahead, 0.2)


def test_a_lidar_has_its_own_rays_up_to_a_number() -> None:
    few = lidar("<samples>1</samples><min_angle>3.1</min_angle><max_angle>3.1</max_angle>")
    assert few is not None
    assert np.allclose(few.directions, [[math.cos(3.1), math.sin(3.1), 0.0]])
    many = lidar("<samples>1800</samples><min_angle>-3.14</min_angle><max_angle>3.14</max_angle>")
    assert many is not None
    assert len(many.directions) == 576
    rows = lidar(
        "<samples>1800</samples><min_angle>-3.14</min_angle><max_angle>3.14</max_angle>",
        "<vertical><samples>64</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></vertical>",
    )
    assert rows is not None
    assert (rows.across.number, rows.up.number) == (72, 8)


@pytest.mark.parametrize(
    "none",
    [
        camera(0.0),
        camera(7.0),
        camera(1.0, near=60.0),
        lidar("<samples>0</samples>"),
        lidar("<samples>10</samples><min_angle>-900</min_angle>"),
        lidar("<samples>10</samples>", range_="<min>5</min><max>1</max>"),
        grid('<sensor name="s" type="imu"/>'),
    ],
)
def test_a_view_that_is_none_has_no_rays(none: Grid | None) -> None:
    assert none is None


def test_a_grid_survives_json() -> None:
    for each in (camera(1.0), lidar("<samples>9</samples>")):
        assert each is not None
        assert convert(to_builtins(each), Grid) == each


@given(st.floats(-3, 3), st.floats(0, 3), st.integers(1, 40))
def test_steps_lie_within_their_ends(lower: float, width: float, number: int) -> None:
    steps = Steps(lower, lower + width, number)
    last = steps.first + (number - 1) * steps.step
    assert lower - 1e-6 <= steps.first <= last <= lower + width + 1e-6
