"""Rigid transforms: their axioms, and scipy as a second opinion."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from checker.model.geometry.transform import (
    Transform,
    rotation_from_quaternion,
    rotation_from_rpy,
)
from tests.model.robots import as_matrix, assert_pose, pose

LENGTHS = st.floats(-10, 10)
VECTORS = st.tuples(LENGTHS, LENGTHS, LENGTHS)
# The right angles make pitch ±π/2, where roll and yaw turn about one axis.
ANGLES = st.one_of(
    st.floats(-7, 7),
    st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi, 1.5707963, -1.57079632679]),
)
RPY = st.tuples(ANGLES, ANGLES, ANGLES)
TRANSFORMS = st.builds(Transform.from_xyz_rpy, VECTORS, RPY)
QUATERNIONS = st.tuples(*[st.floats(-2, 2)] * 4).filter(lambda q: math.hypot(*q) > 1e-3)


@given(VECTORS, RPY)
def test_scipy_agrees_on_roll_pitch_yaw(
    xyz: tuple[float, float, float], rpy: tuple[float, float, float]
) -> None:
    assert_pose(Transform.from_xyz_rpy(xyz, rpy), pose(*xyz, *rpy))


@given(QUATERNIONS)
def test_scipy_agrees_on_quaternions(q: tuple[float, float, float, float]) -> None:
    w, x, y, z = q
    expected = Rotation.from_quat([x, y, z, w]).as_matrix()
    np.testing.assert_allclose(rotation_from_quaternion(*q), expected, atol=1e-12)


@given(RPY)
def test_a_quaternion_turns_as_its_roll_pitch_yaw(rpy: tuple[float, float, float]) -> None:
    x, y, z, w = Rotation.from_euler("xyz", rpy).as_quat()
    turned = rotation_from_quaternion(w, x, y, z)
    np.testing.assert_allclose(turned, rotation_from_rpy(*rpy), atol=1e-12)


def test_a_quaternion_of_zeros_is_refused() -> None:
    with pytest.raises(ValueError, match="zeros"):
        rotation_from_quaternion(0.0, 0.0, 0.0, 0.0)


@given(TRANSFORMS, TRANSFORMS, TRANSFORMS)
def test_chaining_is_associative(a: Transform, b: Transform, c: Transform) -> None:
    assert_pose((a @ b) @ c, as_matrix(a @ (b @ c)), 1e-11)


@given(TRANSFORMS, TRANSFORMS)
def test_chaining_is_the_product_of_matrices(a: Transform, b: Transform) -> None:
    assert_pose(a @ b, as_matrix(a) @ as_matrix(b), 1e-11)


@given(TRANSFORMS)
def test_the_inverse_undoes(a: Transform) -> None:
    assert_pose(a @ a.inverse, np.eye(4), 1e-11)
    assert_pose(a.inverse @ a, np.eye(4), 1e-11)


@given(TRANSFORMS, TRANSFORMS, VECTORS)
def test_points_and_directions(
    a: Transform, b: Transform, vector: tuple[float, float, float]
) -> None:
    np.testing.assert_allclose((a @ b).apply(vector), a.apply(b.apply(vector)), atol=1e-11)
    np.testing.assert_allclose(a.apply(vector), as_matrix(a)[:3] @ [*vector, 1], atol=1e-11)
    np.testing.assert_allclose(a.rotate(vector), as_matrix(a)[:3, :3] @ vector, atol=1e-11)


@given(RPY)
def test_roll_pitch_yaw_round_trip(rpy: tuple[float, float, float]) -> None:
    rotation = rotation_from_rpy(*rpy)
    again = rotation_from_rpy(*Transform(rotation).rpy)
    np.testing.assert_allclose(again, rotation, atol=1e-9)


@given(ANGLES, st.sampled_from([math.pi / 2, -math.pi / 2]), ANGLES)
def test_roll_is_zero_in_gimbal_lock(roll: float, pitch: float, yaw: float) -> None:
    found = Transform(rotation_from_rpy(roll, pitch, yaw)).rpy
    assert found[0] == 0.0
    assert found[1] == pytest.approx(pitch, abs=1e-7)
