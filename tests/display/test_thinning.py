"""Budgets of triangles, equal corners made one, and collapsed edges."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.physics.mesh.surface import (
    GREY,
    Surface,
    appearance_from_json,
    appearance_to_json,
    merge_corners,
    shares,
    thinned,
)
from tests.mesh.files import box, cylinder

COUNTS = st.lists(st.integers(0, 10**9), min_size=1, max_size=50)


@given(COUNTS, st.integers(1, 10**6), st.integers(0, 5000))
def test_shares_keep_to_the_budget(counts: list[int], budget: int, small: int) -> None:
    found = shares(counts, budget, small)
    assert sum(found) <= max(budget, 0)
    assert all(0 <= share <= count for share, count in zip(found, counts, strict=True))
    # Nothing is given away but what rounding takes.
    assert sum(found) >= min(sum(counts), budget) - len(counts)


@given(COUNTS, st.integers(1, 10**6))
def test_a_larger_part_never_has_the_smaller_share(counts: list[int], budget: int) -> None:
    ordered = sorted(counts)
    assert shares(ordered, budget) == sorted(shares(ordered, budget))


def _surface(colours: bool = False) -> Surface:
    corners = np.array(cylinder(1.0, 2.0, 500))
    painted = np.zeros((*corners.shape[:2], 4), np.uint8)
    painted[corners[..., 2] > 0.0] = 255
    return merge_corners(corners, GREY, painted if colours else None, None)


@pytest.mark.parametrize("colours", [False, True])
@pytest.mark.parametrize("most", [1, 7, 300, 1500, 5000])
def test_thinned_surfaces_are_few_and_sound(most: int, colours: bool) -> None:
    found = thinned(_surface(colours), most)
    assert len(found.faces) <= most
    assert found.faces.max() < len(found.vertices)
    assert np.isfinite(found.vertices).all()
    if colours and most >= 300:
        assert found.vertex_colours is not None
        upper = found.vertex_colours[:, 0] == 255
        assert (found.vertices[upper, 2] > 0.0).all()
        assert (found.vertices[~upper, 2] < 0.0).all()


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_thinning_keeps_the_shape_at_any_size(size: float) -> None:
    corners = np.array(cylinder(1.0, 2.0, 500)) * size + 5.0 * size
    found = thinned(merge_corners(corners, GREY, None, None), 400)
    assert np.ptp(found.vertices, axis=0) == pytest.approx([2.0 * size] * 3, rel=0.02)


def test_equal_corners_become_one_where_they_have_the_same_place_in_the_picture() -> None:
    corners = np.array(box(1, 1, 1))
    colours = np.full((12, 3, 4), 7, np.uint8)
    places = np.zeros((12, 3, 2))
    places[6:] = 0.5
    assert len(merge_corners(corners, GREY, None, None).vertices) == 8
    assert len(merge_corners(corners, GREY, colours, np.zeros((12, 3, 2))).vertices) == 8
    assert len(merge_corners(corners, GREY, colours, places).vertices) > 8
    assert len(merge_corners(-0.0 * corners, GREY, None, None).vertices) == 1


@pytest.mark.parametrize("colours", [False, True])
def test_surfaces_survive_json(colours: bool) -> None:
    surface = _surface(colours)
    (found,) = appearance_from_json(appearance_to_json((surface,)))
    assert isinstance(found, Surface)
    assert np.array_equal(found.vertices, surface.vertices)
    assert np.array_equal(found.faces, surface.faces)
    assert found.colour == surface.colour
    assert (found.vertex_colours is None) is not colours
    assert appearance_from_json(appearance_to_json("is empty")) == "is empty"


@pytest.mark.parametrize(
    "changes",
    [
        {"faces": "AAAAAAEAAAAJAAAA"},
        {"vertices": "AADAf wAA"},
        {"vertices": "AADAfwAAwH8AAMB/"},
        {"vertex_colours": "AAAAAA=="},
        {"colour": [1, 2]},
        {"faces": None},
    ],
)
def test_nonsense_is_no_surface(changes: dict[str, object]) -> None:
    said = appearance_to_json((merge_corners(np.array(box(1, 1, 1)), GREY, None, None),))
    said["surfaces"][0].update(changes)
    with pytest.raises(ValueError, match=r"."):
        appearance_from_json(said)
