"""Simple shapes: closed, outside out, as large as their formulas say."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from checker.physics.mesh.surface import Surface
from checker.report.scene.primitives import (
    bar,
    box,
    capsule,
    cone,
    cylinder,
    merge_surfaces,
    sphere,
)

LENGTHS = st.floats(0.01, 100.0)


def solid(surface: Surface) -> trimesh.Trimesh:
    mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    mesh.merge_vertices(merge_norm=True)
    return mesh


@pytest.mark.parametrize(
    ("surface", "volume", "half"),
    [
        (box(), 1.0, (0.5, 0.5, 0.5)),
        (cylinder(), math.pi, (1.0, 1.0, 0.5)),
        (cone(), math.pi / 3, (1.0, 1.0, 0.5)),
        (sphere(), 4 / 3 * math.pi, (1.0, 1.0, 1.0)),
    ],
    ids=["box", "cylinder", "cone", "sphere"],
)
def test_a_shape_is_closed_and_turns_its_outside_out(
    surface: Surface, volume: float, half: tuple[float, ...]
) -> None:
    mesh = solid(surface)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(volume, rel=0.03)
    np.testing.assert_allclose(mesh.bounds, [-np.array(half), half], atol=1e-7)


@given(LENGTHS, LENGTHS)
def test_a_capsule_is_a_cylinder_with_half_balls(radius: float, length: float) -> None:
    mesh = solid(capsule(radius, length))
    assert mesh.is_watertight
    expected = math.pi * radius**2 * (length + 4 / 3 * radius)
    assert mesh.volume == pytest.approx(expected, rel=0.03)
    assert mesh.extents[2] == pytest.approx(length + 2 * radius, rel=1e-5)


@pytest.mark.parametrize("surface", [cylinder(), cone(), sphere(), capsule(0.3, 0.2)])
def test_normals_are_unit_vectors_on_the_side_of_the_triangles(surface: Surface) -> None:
    assert surface.normals is not None
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0, atol=1e-6)
    corners = surface.vertices[surface.faces].astype(float)
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for corner in range(3):
        assert ((surface.normals[surface.faces[:, corner]] * flat).sum(axis=1) > 0.0).all()


POINTS = st.tuples(*[st.floats(-10, 10)] * 3)


@given(POINTS, POINTS, st.floats(0.001, 0.1))
def test_a_bar_lies_between_its_ends(
    start: tuple[float, ...], end: tuple[float, ...], width: float
) -> None:
    length = math.dist(start, end)
    if length < 0.1:
        return
    mesh = solid(bar(start, end, width))
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(length * width**2, rel=1e-2)
    middle = np.add(start, end) / 2
    np.testing.assert_allclose(mesh.vertices.mean(axis=0), middle, atol=1e-4)


def test_surfaces_are_joined_without_mixing_their_corners() -> None:
    whole = merge_surfaces([box(), bar((2, 0, 0), (3, 0, 0), 0.5)])
    assert solid(whole).volume == pytest.approx(1.25)
