"""Rays and boxes, cylinders and the like."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.physics.views.obstacles import SOLIDS, entry_distances, first_hits
from checker.physics.views.rays import Grid, Steps
from tests.effort import examples
from tests.mesh.files import box

GRID = Grid(Steps(-1.0, 1.0, 21), Steps(-0.8, 0.8, 17), 0.0, 100.0)
SIZES = {
    "box": (0.6, 0.4, 0.8),
    "sphere": (0.5,),
    "cylinder": (0.3, 0.9),
    "capsule": (0.3, 0.6),
    "ellipsoid": (0.2, 0.6, 0.4),
}


def reach(kind: str, at: tuple[float, float, float]) -> np.ndarray:
    """Return where the rays from the origin enter a shape that stands at a place."""
    origin = -np.array([at])
    return entry_distances(kind, np.array([SIZES[kind]]), origin, GRID.directions[None])[0]


def outside(kind: str, points: np.ndarray) -> np.ndarray:
    """Return how far points are outside of a shape, as a number whose sign counts."""
    sizes, (x, y, z) = SIZES[kind], points.T
    if kind == "box":
        return (np.abs(points) - np.array(sizes) / 2).max(axis=1)
    if kind == "cylinder":
        return np.maximum(np.hypot(x, y) - sizes[0], np.abs(z) - sizes[1] / 2)
    if kind == "capsule":
        along = np.clip(z, -sizes[1] / 2, sizes[1] / 2)
        return np.sqrt(x**2 + y**2 + (z - along) ** 2) - sizes[0]
    return np.linalg.norm(points / np.array(sizes), axis=1) - 1.0


@settings(max_examples=examples(80))
@given(st.sampled_from(sorted(SOLIDS)), st.floats(0.8, 3), st.floats(-1, 1), st.floats(-1, 1))
def test_a_ray_enters_where_the_surface_is_and_not_before(
    kind: str, x: float, y: float, z: float
) -> None:
    found = reach(kind, (x, y, z))
    hit = np.isfinite(found)
    directions, steps = GRID.directions, np.linspace(0.0, 5.0, 200)
    walked = (steps[:, None, None] * directions).reshape(-1, 3) - (x, y, z)
    inside = (outside(kind, walked) < -1e-9).reshape(200, -1)
    assert np.abs(outside(kind, directions[hit] * found[hit][:, None] - (x, y, z))).max(
        initial=0.0
    ) == pytest.approx(0.0, abs=1e-6)
    assert not inside[:, ~hit].any()
    assert not (inside[:, hit] & (steps[:, None] < found[hit] - 1e-9)).any()


@pytest.mark.parametrize("kind", sorted(SOLIDS))
def test_from_inside_nothing_is_entered(kind: str) -> None:
    assert not np.isfinite(reach(kind, (0.0, 0.0, 0.0))).any()


def test_a_box_is_the_same_as_its_triangles() -> None:
    found = reach("box", (2.0, 0.1, 0.2))
    first, _ = first_hits(np.array(box(0.6, 0.4, 0.8, (2.0, 0.1, 0.2))), GRID)
    assert np.allclose(np.where(np.isfinite(found), found, math.inf), first)


def test_rays_along_a_cylinder_meet_its_end() -> None:
    rays = np.array([[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    origin = np.array([[0.1, 0.0, -2.0]])
    found = entry_distances("cylinder", np.array([[0.3, 1.0]]), origin, rays)
    assert found[0, 0] == pytest.approx(1.5)
    assert math.isnan(found[0, 1])
