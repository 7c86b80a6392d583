"""Rays and triangles: the quick way finds what the plain way finds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.physics.views.obstacles import ball_around, first_hits, in_view
from checker.physics.views.rays import Grid, Steps
from tests.effort import examples
from tests.mesh.files import box

GRIDS = [
    Grid(Steps(-math.pi, math.pi, 48), Steps(-0.5, 0.5, 6), 0.2, 50.0),
    Grid(Steps(2.0, 4.5, 20), Steps(-math.pi / 2, math.pi / 2, 9), 0.0, 50.0),
    Grid(Steps(-0.7, 0.7, 16), Steps(-0.6, 0.6, 12), 0.3, 5.0, (math.tan(0.7), math.tan(0.6))),
    Grid(Steps(math.pi, math.pi, 1), Steps(0.0, 0.0, 1), 0.05, 10.0),
]


def plainly(corners: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Try every triangle with every ray (Möller and Trumbore), front sides only."""
    first = np.full(len(grid.directions), np.inf)
    cut = np.zeros(len(grid.directions), bool)
    for a, b, c in corners:
        one, other = b - a, c - a
        p = np.cross(grid.directions, other)
        volume = p @ one
        with np.errstate(all="ignore"):
            u = -(p @ a) / volume
            q = np.cross(-a, one)
            v = (grid.directions @ q) / volume
            t = (other @ q) / volume
        inside = (volume > 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
        seen = inside & (t >= grid.near_along) & (t <= grid.far)
        first[seen] = np.minimum(first[seen], t[seen])
        cut |= inside & (t < grid.near_along)
    return first, cut


@settings(max_examples=examples(60))
@given(st.integers(0, 2**32 - 1), st.sampled_from(GRIDS), st.sampled_from([0.02, 0.3, 3.0]))
def test_same_as_every_triangle_with_every_ray(seed: int, grid: Grid, size: float) -> None:
    random = np.random.default_rng(seed)
    middles = random.normal(size=(60, 1, 3)) * 1.5
    corners = middles + size * random.normal(size=(60, 3, 3))
    found, expected = first_hits(corners, grid), plainly(corners, grid)
    assert np.allclose(found[0], expected[0])
    assert (found[1] == expected[1]).all()


def test_a_closed_surface_is_seen_from_outside_only() -> None:
    around = np.array(box(1.0, 1.0, 1.0))
    for grid in GRIDS:
        first, cut = first_hits(around, grid)
        assert not np.isfinite(first).any()
        assert not cut.any()
    first, _ = first_hits(np.array(box(1.0, 1.0, 1.0, (2.0, 0.0, 0.0))), GRIDS[2])
    assert first.min() == pytest.approx(1.5, rel=0.02)


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e12, 0.0])
def test_corners_that_are_nowhere_do_no_harm(value: float) -> None:
    corners = np.array(box(1.0, 1.0, 1.0, (2.0, 0.0, 0.0)))
    corners[0, 0, 0] = value
    first, _ = first_hits(corners, GRIDS[0])
    assert np.isfinite(first).any()
    assert first_hits(np.empty((0, 3, 3)), GRIDS[0])[0].shape == (288,)


@settings(max_examples=examples(300))
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from(GRIDS),
    st.sampled_from([0.05, 0.5, 3.0]),
    st.sampled_from([0.1, 1.5]),
)
def test_nothing_out_of_view_is_met(seed: int, grid: Grid, size: float, away: float) -> None:
    random = np.random.default_rng(seed)
    corners = away * random.normal(size=3) + size * random.normal(size=(30, 3, 3))
    if not in_view(*ball_around(corners), grid):
        first, cut = first_hits(corners, grid)
        assert not np.isfinite(first).any()
        assert not cut.any()


def test_what_is_behind_a_camera_is_out_of_its_view() -> None:
    camera = GRIDS[2]
    for place, seen in (((2.0, 0.0, 0.0), True), ((-2.0, 0.0, 0.0), False), ((0, 0, 3), False)):
        corners = np.array(box(0.4, 0.4, 0.4, place))
        assert in_view(*ball_around(corners), camera) is seen
    assert in_view(np.array([-2.0, math.nan, 0.0]), 0.1, camera)
    assert in_view(np.array([-2.0, 0.0, 0.0]), 5.0, camera)
