"""Boxes around links hold every point of their shapes, and no more."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.model.geometry.boxes import Box
from checker.model.mesh import Mesh
from checker.source.text import Located
from tests.model.robots import as_matrix, sdf

BALL = "<sphere><radius>0.5</radius></sphere>"
MESH = "<mesh><uri>a.stl</uri></mesh>"
angles = st.floats(-math.pi, math.pi)
scales = st.floats(-3, 3)
TENT = Mesh(
    path="a.stl",
    format="stl",
    triangles=4,
    low=(-1, -1, 0),
    high=(1, 1, 2),
    hull=((1, 0, 0), (-1, 1, 0), (-1, -1, 0), (0, 0, 2)),
    parts=("tent",),
)


@dataclass(frozen=True)
class OneMesh:
    """Finds one mesh behind each URI."""

    mesh: Mesh

    def load(self, uri: Located[str]) -> Mesh:
        assert uri.value == "a.stl"
        return self.mesh


def link(collision: str, visual: str = "", pose: str = "0 0 0 0 0 0") -> str:
    shapes = f'<collision name="c"><geometry>{collision}</geometry></collision>'
    if visual:
        shapes += f'<visual name="v"><geometry>{visual}</geometry></visual>'
    return f'<link name="a"><pose>{pose}</pose>{shapes}</link>'


@given(angles, angles, angles)
def test_a_box_turned_about(roll: float, pitch: float, yaw: float) -> None:
    robot = sdf(link("<box><size>1 2 3</size></box>", pose=f"1 2 3 {roll} {pitch} {yaw}"))
    box = robot.box_of(robot.links[0])
    assert box is not None
    matrix = as_matrix(robot.pose_of("a"))
    corners = [
        (matrix @ [x / 2, y, 1.5 * z, 1.0])[:3]
        for x, y, z in itertools.product((-1.0, 1.0), repeat=3)
    ]
    for i in range(3):
        assert box.low[i] == pytest.approx(min(corner[i] for corner in corners))
        assert box.high[i] == pytest.approx(max(corner[i] for corner in corners))
    assert box.centre == pytest.approx((1, 2, 3))


def test_a_link_with_a_mesh_that_is_not_known_has_no_known_box() -> None:
    robot = sdf(link(BALL, MESH))
    assert robot.box_of(robot.links[0]) is None
    collisions = robot.box_of(robot.links[0], visuals_too=False)
    assert collisions == Box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))


def test_a_link_without_shapes_or_place_has_no_box() -> None:
    robot = sdf(
        '<link name="a"/>' + link(BALL).replace("<pose>", "<pose frame='x'>").replace('"a"', '"b"')
    )
    assert robot.box_of(robot.links[0]) is None
    assert robot.box_of(robot.links[1]) is None


@pytest.mark.parametrize(
    ("shift", "gap"),
    [((0, 0, 0), 0), ((1, 0, 0), 0), ((3, 0, 0), 2), ((4, 5, 0), 5), ((2, 3, 3), 3)],
)
def test_gap_between_boxes(shift: tuple[float, float, float], gap: float) -> None:
    one = Box((0, 0, 0), (1, 1, 1))
    x, y, z = shift
    other = Box((x, y, z), (x + 1, y + 1, z + 1))
    assert one.gap(other) == other.gap(one) == pytest.approx(gap)


@given(angles, angles, angles, scales, scales, scales)
def test_a_mesh_counts_by_its_hull_scaled_and_turned(
    roll: float, pitch: float, yaw: float, x: float, y: float, z: float
) -> None:
    mesh = f"<mesh><uri>a.stl</uri><scale>{x} {y} {z}</scale></mesh>"
    robot = replace(sdf(link(mesh, pose=f"1 2 3 {roll} {pitch} {yaw}")), meshes=OneMesh(TENT))
    box = robot.box_of(robot.links[0])
    assert box is not None
    matrix = as_matrix(robot.pose_of("a"))
    points = [(matrix @ [x * a, y * b, z * c, 1.0])[:3] for a, b, c in TENT.hull]
    for i in range(3):
        assert box.low[i] == pytest.approx(min(point[i] for point in points))
        assert box.high[i] == pytest.approx(max(point[i] for point in points))


def test_a_flat_mesh_counts_by_its_box() -> None:
    robot = replace(sdf(link(MESH)), meshes=OneMesh(replace(TENT, hull=())))
    assert robot.box_of(robot.links[0]) == Box(TENT.low, TENT.high)


def test_a_part_of_a_mesh_reaches_as_far_as_it_does() -> None:
    lid = replace(TENT, low=(1.0, 0.0, 0.0), high=(3.0, 2.0, 1.0), hull=())
    whole = replace(TENT, parts=("tent", "lid"), picks={"lid": lid})
    for centred, box in ((0, Box(lid.low, lid.high)), (1, Box((-1, -1, -0.5), (1, 1, 0.5)))):
        submesh = f"<submesh><name>lid</name><center>{centred}</center></submesh>"
        mesh = f"<mesh><uri>a.stl</uri>{submesh}</mesh>"
        robot = replace(sdf(link(mesh)), meshes=OneMesh(whole))
        assert robot.box_of(robot.links[0]) == box


@pytest.mark.parametrize(
    ("submesh", "known"),
    [
        ("<name>tent</name>", True),
        ("<name>tent</name><center>false</center>", True),
        ("<name>other</name>", False),
        ("", False),
    ],
)
def test_one_part_of_a_mesh_is_known_when_it_is_the_only_one(submesh: str, known: bool) -> None:
    mesh = f"<mesh><uri>a.stl</uri><submesh>{submesh}</submesh></mesh>"
    robot = replace(sdf(link(mesh)), meshes=OneMesh(TENT))
    assert (robot.box_of(robot.links[0]) is not None) is known
    assert robot.mesh_uses[0].file is TENT
    assert (robot.mesh_uses[0].mesh is TENT) is known
