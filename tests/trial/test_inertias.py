"""Inertias as MuJoCo takes them: what is told without solving for moments is what solving tells."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from checker.physics.trial.mjcf.inertials import (
    BodyInertia,
    Rows,
    _is_clearly_positive,
    _second_moments,
    _turned,
)

MOMENTS = st.floats(-1.0, 1.0) | st.floats(0.0, 1e-5)


@st.composite
def symmetric(draw: st.DrawFn) -> Rows:
    xx, xy, xz, yy, yz, zz = (draw(MOMENTS) for _ in range(6))
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)


@given(symmetric())
def test_what_is_clearly_positive_is_so(moments: Rows) -> None:
    values = np.linalg.eigvalsh(np.array(moments))
    if _is_clearly_positive(moments):
        assert values[0] > 5e-7 * values.sum()
        assert BodyInertia(1.0, (0.0, 0.0, 0.0), moments).sound
    elif values.sum() > 1e-5:
        assert values[0] < 1.5e-6 * values.sum()


@given(symmetric())
def test_second_moments_are_half_the_trace_less_the_inertia(moments: Rows) -> None:
    m = np.array(moments)
    assert np.allclose(np.array(_second_moments(moments)), np.trace(m) / 2 * np.eye(3) - m)


@given(symmetric(), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_turning_is_that_of_matrices(moments: Rows, yaw: float, roll: float) -> None:
    z = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    x = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    a, b, c = (tuple(map(float, row)) for row in (z @ x).tolist())
    turned = np.array(_turned(moments, (a, b, c)))  # type: ignore[arg-type]  # three of three
    assert np.allclose(turned, z @ x @ np.array(moments) @ x.T @ z.T, atol=1e-12)
    assert (turned == turned.T).all()
