"""How far shapes reach: the support function against points of the shape itself."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.geometry.convex import extent, support
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.mesh import Mesh
from checker.source.text import Located
from tests.model.robots import sdf

SHAPES = {
    "box": "<size>0.2 0.4 0.6</size>",
    "sphere": "<radius>0.3</radius>",
    "cylinder": "<radius>0.1</radius><length>0.8</length>",
    "capsule": "<radius>0.1</radius><length>0.8</length>",
    "cone": "<radius>0.2</radius><length>0.6</length>",
    "ellipsoid": "<radii>0.1 0.2 0.3</radii>",
}
AT_HOME = Transform()
UP, ALONG_X = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)

angles = st.floats(-math.pi, math.pi)
lengths = st.floats(-10, 10)
poses = st.builds(
    Transform.from_xyz_rpy, st.tuples(lengths, lengths, lengths), st.tuples(angles, angles, angles)
)


@st.composite
def directions(draw: st.DrawFn) -> Vector:
    azimuth, height = draw(angles), draw(st.floats(-1, 1))
    side = math.sqrt(1 - height * height)
    return (side * math.cos(azimuth), side * math.sin(azimuth), height)


def geometry(shape: str, sizes: str) -> Geometry:
    inside = f"<geometry><{shape}>{sizes}</{shape}></geometry>"
    robot = sdf(f'<link name="a"><collision name="c">{inside}</collision></link>')
    return robot.links[0].collisions[0].geometry


def points(shape: str) -> list[Vector]:
    """Return points of the surface, in the shape's own frame."""
    rounds = [2 * math.pi * turn / 24 for turn in range(24)]
    ring = [(math.cos(a), math.sin(a)) for a in rounds]
    ball = [
        (math.cos(b) * x, math.cos(b) * y, math.sin(b))
        for b in (math.pi * k / 24 for k in range(-12, 13))
        for x, y in ring
    ]
    ends = (-1, 1)
    match shape:
        case "box":
            return [(0.1 * x, 0.2 * y, 0.3 * z) for x in ends for y in ends for z in ends]
        case "sphere":
            return [(0.3 * x, 0.3 * y, 0.3 * z) for x, y, z in ball]
        case "cylinder":
            return [(0.1 * x, 0.1 * y, 0.4 * z) for x, y in ring for z in ends]
        case "capsule":
            return [(0.1 * x, 0.1 * y, 0.1 * z + 0.4 * end) for x, y, z in ball for end in ends]
        case "cone":
            return [(0.0, 0.0, 0.3), *((0.2 * x, 0.2 * y, -0.3) for x, y in ring)]
    return [(0.1 * x, 0.2 * y, 0.3 * z) for x, y, z in ball]


@pytest.mark.parametrize(
    ("shape", "up", "along_x"),
    [
        ("box", 0.3, 0.1),
        ("sphere", 0.3, 0.3),
        ("cylinder", 0.4, 0.1),
        ("capsule", 0.5, 0.1),
        ("cone", 0.3, 0.2),
        ("ellipsoid", 0.3, 0.1),
    ],
)
def test_along_its_axes(shape: str, up: float, along_x: float) -> None:
    body = geometry(shape, SHAPES[shape])
    assert support(body, AT_HOME, UP) == pytest.approx(up)
    assert support(body, AT_HOME, ALONG_X) == pytest.approx(along_x)


@pytest.mark.parametrize("shape", SHAPES)
@given(pose=poses, direction=directions())
def test_no_point_reaches_farther_and_some_point_as_far(
    shape: str, pose: Transform, direction: Vector
) -> None:
    farthest = max(
        sum(a * b for a, b in zip(direction, pose.apply(point), strict=True))
        for point in points(shape)
    )
    reach = support(geometry(shape, SHAPES[shape]), pose, direction)
    assert reach is not None
    assert farthest <= reach + 1e-9
    # The points lie 15° and 7.5° apart, on radii of at most 0.3 m.
    assert reach <= farthest + 0.3 * (1 - math.cos(math.radians(15)))


@pytest.mark.parametrize("shape", SHAPES)
@given(pose=poses, direction=directions())
def test_an_extent_is_the_support_both_ways(shape: str, pose: Transform, direction: Vector) -> None:
    body = geometry(shape, SHAPES[shape])
    x, y, z = direction
    both = extent(body, pose, direction)
    along, against = support(body, pose, direction), support(body, pose, (-x, -y, -z))
    assert both is not None
    assert along is not None
    assert against is not None
    assert both == pytest.approx((-against, along), abs=1e-12)


@pytest.mark.parametrize("shape", ["mesh", "plane", "heightmap", "empty"])
def test_what_has_no_known_bounds_has_no_support(shape: str) -> None:
    assert support(geometry(shape, ""), AT_HOME, UP) is None


class OneMesh:
    """A mesh that has no file."""

    def __init__(self, hull: tuple[Vector, ...]) -> None:
        self.mesh = Mesh("a.stl", "stl", 1, (-1, -1, -1), (1, 1, 1), hull=hull)

    def load(self, uri: Located[str]) -> Mesh:  # noqa: ARG002 - as a `Meshes` has it
        return self.mesh


@given(
    pose=poses,
    direction=directions(),
    few=st.lists(st.tuples(lengths, lengths, lengths), min_size=4, max_size=50).map(tuple),
)
def test_a_mesh_of_many_corners_reaches_exactly_as_far_as_the_farthest(
    pose: Transform, direction: Vector, few: tuple[Vector, ...]
) -> None:
    body = geometry("mesh", "<uri>a.stl</uri><scale>0.1 -2 3</scale>")
    # The same corners again and again are more than are gone through one by one.
    many = few * 51
    assert extent(body, pose, direction, OneMesh(many)) == extent(
        body, pose, direction, OneMesh(few)
    )
