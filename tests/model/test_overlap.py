"""How deep shapes are inside each other: never less than the truth, and nearly never more."""

from __future__ import annotations

import math
from functools import partial
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.geometry.convex import face_directions, overlap_depth
from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from tests.model.robots import sdf

LENGTH = st.floats(0.05, 2.0)
PLACE = st.floats(-1.0, 1.0)
ANGLE = st.floats(-math.pi, math.pi)


def pair(one: str, other: str) -> tuple[Robot, Placed, Placed]:
    """Return the two collisions of a robot, each given as pose and shape."""
    links = [
        f"<link name='l{i}'><collision name='c'>{each}</collision></link>"
        for i, each in enumerate((one, other))
    ]
    robot = sdf("".join(links))
    first, second = (next(place_shapes(robot, link, link.collisions)) for link in robot.links)
    return robot, first, second


def depth(one: str, other: str, enough: float = -math.inf) -> float:
    robot, first, second = pair(one, other)
    start = list(face_directions(first.pose.rotation, second.pose.rotation))
    return overlap_depth(
        partial(first.support, robot), partial(second.support, robot), start, enough
    )


def shape(tag: str, pose: str = "0 0 0 0 0 0", **lengths: object) -> str:
    inside = "".join(f"<{name}>{value}</{name}>" for name, value in lengths.items())
    return f"<pose>{pose}</pose><geometry><{tag}>{inside}</{tag}></geometry>"


@given(LENGTH, LENGTH, PLACE, PLACE, PLACE)
def test_spheres(one: float, other: float, x: float, y: float, z: float) -> None:
    found = depth(
        shape("sphere", radius=one), shape("sphere", f"{x!r} {y!r} {z!r} 0 0 0", radius=other)
    )
    expected = one + other - math.hypot(x, y, z)
    assert expected - 1e-9 <= found <= expected + 1e-3


@given(
    st.tuples(LENGTH, LENGTH, LENGTH),
    st.tuples(LENGTH, LENGTH, LENGTH),
    st.tuples(PLACE, PLACE, PLACE),
    st.tuples(ANGLE, ANGLE, ANGLE),
)
def test_boxes_part_along_a_face_or_two_edges(
    one: Vector, other: Vector, xyz: Vector, rpy: Vector
) -> None:
    pose = " ".join(map(repr, (*xyz, *rpy)))
    found = depth(
        shape("box", size=" ".join(map(repr, one))),
        shape("box", pose, size=" ".join(map(repr, other))),
    )
    expected = separating_axes(one, other, Transform.from_xyz_rpy(xyz, rpy))
    assert found == pytest.approx(expected, abs=1e-6) or (expected < 0 and found <= 0)


def separating_axes(one: Vector, other: Vector, pose: Transform) -> float:
    """The least overlap of two boxes over the 15 axes that can part them."""
    a, b = np.eye(3), np.array(pose.rotation)
    axes = [*a.T, *b.T, *(np.cross(u, v) for u, v in product(a.T, b.T))]
    depths = []
    for axis in axes:
        length = np.linalg.norm(axis)
        if length < 1e-6:
            continue
        d = axis / length
        reach = np.abs(d @ a) @ np.array(one) / 2 + np.abs(d @ b) @ np.array(other) / 2
        depths.append(float(reach - abs(d @ np.array(pose.translation))))
    return min(depths)


def test_a_peg_in_a_plate() -> None:
    plate = shape("box", size="1 1 0.1")
    peg = shape("cylinder", "0.1 0.2 0.45 0 0 0", radius=0.02, length=1)
    assert depth(plate, peg) == pytest.approx(0.1)


def test_leaning_cylinder_on_a_corner() -> None:
    box = shape("box", size="1 1 1")
    leaning = shape("cylinder", "0.7 0 0.7 0 0.7853981633974483 0", radius=0.4, length=0.2)
    # Along (1, 0, 1)/√2 the box reaches √2/2 and the cylinder, whose axis that is, 0.1 back.
    assert depth(box, leaning) == pytest.approx(
        math.sqrt(2) / 2 + 0.1 - 0.7 * math.sqrt(2), abs=1e-4
    )


def test_what_is_deep_enough_is_searched_to_the_end_and_no_farther() -> None:
    box = shape("box", size="1 1 1")
    assert depth(box, shape("box", "0.995 0 0 0 0 0", size="1 1 1"), 0.01) <= 0.01
    assert depth(box, shape("box", "0.98 0 0 0 0 0", size="1 1 1"), 0.01) == pytest.approx(0.02)
