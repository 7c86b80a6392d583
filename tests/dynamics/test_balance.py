"""What a robot stands on, and how far the ground can tilt: against trigonometry."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from checker.physics.mass.balance import Point, convex_hull, margin
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.robot_mass import weigh
from tests.dynamics.bodies import Pose, collision, inertial, link, sizes
from tests.model.robots import sdf

QUARTER = math.pi / 2


def standing(content: str) -> MassProperties:
    return weigh(sdf(content))


def corners(properties: MassProperties) -> set[tuple[float, float]]:
    return {(round(x, 9), round(y, 9)) for x, y in properties.support}


def body(*shapes: str, centre: tuple[float, float, float] = (0, 0, 0)) -> str:
    return link("body", inertial(5.0, np.eye(3), (*centre, 0, 0, 0)) + "".join(shapes))


@given(sizes, sizes, sizes, st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(0.1, 1.0))
def test_a_box_tips_over_its_nearest_edge(
    length: float, width: float, height: float, ahead: float, aside: float, up: float
) -> None:
    x, y, z = ahead * length, aside * width, (up - 0.5) * height
    properties = standing(body(collision("box", f"{length} {width} {height}"), centre=(x, y, z)))
    assert corners(properties) == {
        (round(a * length / 2, 9), round(b * width / 2, 9)) for a in (-1, 1) for b in (-1, 1)
    }
    nearest = min(length / 2 - abs(x), width / 2 - abs(y))
    assert properties.tip_angle == pytest.approx(math.atan(nearest / (up * height)), rel=1e-6)
    assert properties.support_height == pytest.approx(-height / 2)


def wheel(x: float, y: float, number: int) -> str:
    pose = (x, y, 0.1, QUARTER, 0, 0)
    return collision("cylinder", "<radius>0.1</radius><length>0.05</length>", pose, f"c{number}")


def test_wheels_stand_on_their_whole_width() -> None:
    shapes = [wheel(x, y, 2 * x + y > 0) for x in (-0.3, 0.3) for y in (-0.2, 0.2)]
    properties = standing(body(*shapes, centre=(0, 0, 0.3)))
    assert corners(properties) == {(x, y) for x in (-0.3, 0.3) for y in (-0.225, 0.225)}
    assert properties.tip_angle == pytest.approx(math.atan(0.225 / 0.3))


def test_an_upright_cylinder_stands_on_its_rim() -> None:
    shape = collision("cylinder", "<radius>0.2</radius><length>1</length>")
    properties = standing(body(shape))
    assert len(properties.support) == 16
    assert properties.tip_angle == pytest.approx(math.atan(0.2 / 0.5), rel=0.03)


def test_three_feet_that_are_balls() -> None:
    feet = [(0.4, 0.0), (-0.2, 0.3), (-0.2, -0.3)]
    shapes = [
        collision("sphere", "<radius>0.05</radius>", (x, y, 0, 0, 0, 0), f"c{x}{y}")
        for x, y in feet
    ]
    properties = standing(body(*shapes, centre=(0, 0, 0.4)))
    assert corners(properties) == set(feet)
    assert properties.tip_angle is not None
    assert 0 < properties.tip_angle < math.atan(0.2 / 0.45) + 1e-12


def test_what_hangs_above_the_ground_does_not_support() -> None:
    low = collision("box", "1 1 0.1")
    high = collision("box", "3 3 0.1", (0, 0, 0.02, 0, 0, 0), "high")
    assert max(x for x, _ in standing(body(low, high)).support) == pytest.approx(0.5)
    near = collision("box", "3 3 0.1", (0, 0, 0.005, 0, 0, 0), "near")
    assert max(x for x, _ in standing(body(low, near)).support) == pytest.approx(1.5)


@pytest.mark.parametrize(
    ("shape", "size", "pose", "lowest"),
    [
        ("capsule", "<radius>0.1</radius><length>0.6</length>", (0, 0, 0, QUARTER, 0, 0), 2),
        ("ellipsoid", "<radii>0.1 0.2 0.3</radii>", (0, 0, 0, 0.3, 0.2, 0.1), 1),
        ("cone", "<radius>0.1</radius><length>0.6</length>", (0, 0, 0, 0, 0, 0), 16),
        ("cone", "<radius>0.1</radius><length>0.6</length>", (0, 0, 0, math.pi, 0, 0), 1),
    ],
)
def test_round_shapes_stand_on_their_lowest_points(
    shape: str, size: str, pose: Pose, lowest: int
) -> None:
    content = body(collision(shape, size, pose))
    properties = weigh(sdf(content, version="1.11"))
    assert len(properties.support) == lowest


def test_a_centre_of_mass_beside_the_support_tips_at_once() -> None:
    properties = standing(body(collision("box", "1 1 1"), centre=(0.9, 0, 0)))
    assert properties.tip_angle == pytest.approx(-math.atan(0.4 / 0.5))


def test_two_wheels_alone_do_not_stand() -> None:
    ball = "<radius>0.1</radius>"
    shapes = [collision("sphere", ball, (0, y, 0, 0, 0, 0), f"c{y}") for y in (-0.2, 0.2)]
    properties = standing(body(*shapes, centre=(0.05, 0, 0.2)))
    assert properties.tip_angle == pytest.approx(-math.atan(0.05 / 0.3))


def test_without_collision_there_is_no_support() -> None:
    properties = standing(body())
    assert (properties.support, properties.support_height, properties.tip_angle) == ((), None, None)
    assert not properties.support_unknown


def test_a_mesh_that_was_not_looked_at_leaves_the_support_open() -> None:
    mesh = collision("mesh", "<uri>meshes/foot.dae</uri>")
    properties = standing(body(collision("box", "1 1 1"), mesh))
    assert properties.tip_angle is None
    assert properties.support_unknown == "meshes/foot.dae was not looked for"
    assert properties.gravity_torques == {}


coordinates = st.floats(-10, 10).map(lambda value: round(value, 3))
points = st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=40)


@given(points)
def test_the_hull_is_the_one_of_scipy(cloud: list[Point]) -> None:
    spread = np.linalg.svd(np.array(cloud) - np.mean(cloud, axis=0), compute_uv=False)
    assume(spread[-1] > 0.01)
    area = ConvexHull(np.array(cloud)).volume
    hull = convex_hull(cloud)
    x, y = np.array(hull).T
    assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 == pytest.approx(area)


@given(points, st.tuples(coordinates, coordinates))
def test_no_corner_of_the_cloud_is_outside_its_hull(cloud: list[Point], point: Point) -> None:
    hull = convex_hull(cloud)
    assume(len(hull) > 2)
    assert all(margin(hull, corner) >= -1e-9 for corner in cloud)
    # A point moves the margin by no more than it moves itself.
    shifted = (point[0] + 0.5, point[1])
    assert abs(margin(hull, point) - margin(hull, shifted)) <= 0.5 + 1e-9


def test_margins_of_a_square() -> None:
    square = convex_hull([(0, 0), (2, 0), (2, 2), (0, 2), (1, 1), (1, 0)])
    assert square == ((0, 0), (2, 0), (2, 2), (0, 2))
    assert margin(square, (1, 1)) == 1
    assert margin(square, (1.5, 1)) == 0.5
    assert margin(square, (5, 6)) == -5
    assert margin(((0, 0), (2, 0)), (1, 0)) == 0
    assert margin(((0, 0),), (3, 4)) == -5
