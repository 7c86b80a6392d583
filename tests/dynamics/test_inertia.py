"""Inertias of links: bodies whose moments are known, bodies that cannot be, hostile numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from checker.physics.mass.link_inertias import link_inertias
from checker.physics.mass.mass_properties import LinkInertia
from checker.physics.mass.robot_mass import weigh
from tests.dynamics.bodies import (
    HOME,
    Matrix,
    Pose,
    box,
    cylinder,
    inertial,
    link,
    masses,
    poses,
    sizes,
    sphere,
)
from tests.model.robots import pose as matrix_of
from tests.model.robots import sdf, urdf


def weighed(mass: float, moments: Matrix, own: Pose = HOME, at: Pose = HOME) -> LinkInertia:
    return weigh(sdf(link("body", inertial(mass, moments, own), at))).links["body"]


def turned(moments: Matrix, rotation: Matrix) -> Matrix:
    return np.asarray(rotation @ moments @ rotation.T)


rotations = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(
    lambda angles: np.asarray(Rotation.from_euler("xyz", angles).as_matrix())
)
solids = st.one_of(
    st.builds(lambda m, x, y, z: (m, box(m, x, y, z)), masses, sizes, sizes, sizes),
    st.builds(lambda m, r, h: (m, cylinder(m, r, h)), masses, sizes, sizes),
    st.builds(lambda m, r: (m, sphere(m, r)), masses, sizes),
)


@given(solids, rotations, poses, poses)
def test_principal_moments_are_those_of_the_body_however_it_is_posed(
    solid: tuple[float, Matrix], rotation: Matrix, own: Pose, at: Pose
) -> None:
    mass, moments = solid
    inertia = weighed(mass, turned(moments, rotation), own, at)
    expected = sorted(np.diag(moments))
    np.testing.assert_allclose(inertia.principal, expected, rtol=1e-9)
    assert inertia.gyration_radius == pytest.approx(math.sqrt(expected[-1] / mass))
    assert inertia.pseudo_eigenvalue > -1e-12
    centre = (matrix_of(*at) @ matrix_of(*own))[:3, 3]  # type: ignore[call-arg]
    np.testing.assert_allclose(inertia.centre, centre, atol=1e-9)


@given(st.integers(0, 2**32 - 1), rotations)
def test_principal_moments_of_a_convex_mesh(seed: int, rotation: Matrix) -> None:
    points = np.random.default_rng(seed).normal(size=(12, 3))
    body = trimesh.Trimesh(points).convex_hull
    inertia = weighed(float(body.volume), turned(np.asarray(body.moment_inertia), rotation))
    expected = np.linalg.eigvalsh(body.moment_inertia)
    np.testing.assert_allclose(inertia.principal, expected, rtol=1e-9)
    assert inertia.pseudo_eigenvalue > 0


@pytest.mark.parametrize(
    ("mass", "moments"),
    [(1.0, (1, 1, 3)), (1.0, (-1, 1, 1)), (1.0, (0, 1, 1.5)), (-1.0, (1, 1, 1)), (1e-9, (1, 1, 3))],
)
def test_no_body_has_such_an_inertia(mass: float, moments: tuple[float, float, float]) -> None:
    assert weighed(mass, np.diag(moments)).pseudo_eigenvalue < -0.1


def test_a_plate_a_rod_and_a_point_are_the_bounds_of_what_is_possible() -> None:
    for moments in ((1, 1, 2), (0, 1, 1), (0, 0, 0)):
        assert weighed(1.0, np.diag(moments)).pseudo_eigenvalue == pytest.approx(0.0, abs=1e-15)


@given(st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1)), rotations, masses)
def test_the_pseudo_inertia_tells_what_breaks_the_triangle_inequality(
    moments: tuple[float, float, float], rotation: Matrix, mass: float
) -> None:
    first, second, third = sorted(moments)
    least = (first + second - third) / 2
    inertia = weighed(mass, turned(np.diag(moments), rotation))
    if abs(least) > 1e-9:
        assert (inertia.pseudo_eigenvalue < 0) is (least < 0)


@given(masses, sizes, st.floats(1e-3, 1e3))
def test_the_smallest_eigenvalue_has_no_unit(mass: float, size: float, factor: float) -> None:
    small, large = box(mass, size, 2 * size, 3 * size), box(mass, size, 2 * size, 3 * size) * factor
    one, other = weighed(mass, small).pseudo_eigenvalue, weighed(mass, large).pseudo_eigenvalue
    assert one == pytest.approx(other)


def test_a_link_without_inertial_has_what_simulators_take() -> None:
    in_sdf = weigh(sdf('<link name="body"/>')).links["body"]
    assert (in_sdf.mass, in_sdf.principal) == (1.0, (1.0, 1.0, 1.0))
    in_urdf = weigh(urdf('<link name="body"/>')).links["body"]
    assert (in_urdf.mass, in_urdf.principal) == (0.0, (0.0, 0.0, 0.0))


HOSTILE = ("0", "-1", "1e300", "-1e300", "1e-320", "inf", "-inf", "nan", "one", "2")
hostile = st.sampled_from(HOSTILE)


@given(st.tuples(*[hostile] * 13))
def test_no_number_raises_and_none_is_hidden(numbers: tuple[str, ...]) -> None:
    mass, *others = numbers
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    moments = "".join(f"<{n}>{value}</{n}>" for n, value in zip(names, others[:6], strict=True))
    inside = (
        f"<inertial><pose>{' '.join(others[6:])}</pose><mass>{mass}</mass>"
        f"<inertia>{moments}</inertia></inertial>"
    )
    sound = link("wheel", inertial(1.0, np.eye(3)))
    properties = weigh(sdf(link("body", inside) + sound + '<link name="other"/>'))
    inertia = properties.links["body"]
    if mass in ("0", "-1", "-1e300", "1e300", "inf", "-inf"):
        assert inertia.mass == float(mass)
    if {"inf", "-inf"}.intersection(others[:6]):
        assert all(map(math.isnan, inertia.principal))
        assert math.isnan(inertia.pseudo_eigenvalue)
    assert properties.centre is None or all(map(math.isfinite, properties.centre))


@given(solids, rotations, poses, poses)
def test_links_weigh_the_same_without_numpy(
    solid: tuple[float, Matrix], rotation: Matrix, own: Pose, at: Pose
) -> None:
    mass, moments = solid
    rows = turned(moments, rotation)
    robot = sdf(link("body", inertial(mass, rows, own), at))
    ours, theirs = link_inertias(robot).links["body"], weigh(robot).links["body"]
    np.testing.assert_allclose(ours.principal, theirs.principal, rtol=1e-9, atol=1e-15 * mass)
    assert ours.pseudo_eigenvalue == pytest.approx(theirs.pseudo_eigenvalue, abs=1e-13)
    assert ours.piece_eigenvalue == pytest.approx(theirs.piece_eigenvalue, abs=1e-12)
    assert ours.gyration_radius == pytest.approx(theirs.gyration_radius)
