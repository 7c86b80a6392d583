"""Volumes, moments and reaches of shapes: against trimesh's bodies of the same sizes."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from checker.model.geometry.bodies import Body, together
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.solids import solid_of
from checker.model.geometry.transform import Transform
from checker.model.mesh import Mesh, Meshes, MeshFault, NoMeshes
from checker.physics.mass.link_geometry import farthest
from checker.source.text import Located
from tests.dynamics.bodies import collision, link, poses
from tests.model.robots import as_matrix, sdf

TURN = trimesh.transformations.rotation_matrix(math.pi, (1, 0, 0))
BODIES = {
    "box": ("0.2 0.4 0.6", trimesh.creation.box((0.2, 0.4, 0.6))),
    "sphere": ("<radius>0.3</radius>", trimesh.creation.icosphere(4, 0.3)),
    "cylinder": (
        "<radius>0.1</radius><length>0.8</length>",
        trimesh.creation.cylinder(0.1, 0.8, sections=128),
    ),
    "capsule": (
        "<radius>0.1</radius><length>0.8</length>",
        trimesh.creation.capsule(0.8, 0.1, count=[64, 64]),
    ),
    "cone": (
        "<radius>0.2</radius><length>0.6</length>",
        trimesh.creation.cone(0.2, 0.6, sections=128).apply_translation((0, 0, -0.3)),
    ),
    "ellipsoid": (
        "<radii>0.1 0.2 0.3</radii>",
        trimesh.creation.icosphere(4).apply_scale((0.1, 0.2, 0.3)),
    ),
}
shapes = st.sampled_from(sorted(BODIES))


def geometry(shape: str, size: str) -> Geometry:
    robot = sdf(link("body", collision(shape, size)), version="1.11")
    return robot.links[0].collisions[0].geometry


def volume_of(shape: Geometry, meshes: Meshes) -> float | None:
    solid = solid_of(shape, meshes)
    return None if solid is None else solid.amount


@pytest.mark.parametrize("shape", sorted(BODIES))
def test_volumes_and_moments(shape: str) -> None:
    size, body = BODIES[shape]
    at = Transform.from_xyz_rpy((0.1, -0.2, 0.3), (0.4, -0.5, 0.6))
    solid = solid_of(geometry(shape, size), NoMeshes())
    assert solid is not None
    placed, moved = solid.placed(at), body.copy().apply_transform(as_matrix(at))
    assert placed.amount == pytest.approx(moved.volume, rel=0.01)
    assert placed.centre == pytest.approx(tuple(moved.center_mass), abs=1e-3)
    xx, xy, xz, yy, yz, zz = placed.moments(2.0)
    expected = moved.moment_inertia * 2.0 / moved.volume
    ours = np.array(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))
    assert ours == pytest.approx(expected, rel=0.01, abs=0.01 * expected.max())


def test_bodies_together_have_the_moments_of_one() -> None:
    halves = [
        Body(0.5, (side * 0.25, 0.0, 0.0), ((0.25 / 12, 0, 0), (0, 1 / 12, 0), (0, 0, 1 / 12)))
        for side in (-1, 1)
    ]
    whole = together(halves)
    assert whole is not None
    assert whole.moments(3.0) == pytest.approx((0.5, 0, 0, 0.5, 0, 0.5))
    assert together([]) is None


@given(shapes, poses, st.tuples(*[st.floats(-3, 3)] * 3))
def test_the_farthest_point(
    shape: str, pose: tuple[float, ...], point: tuple[float, float, float]
) -> None:
    size, body = BODIES[shape]
    x, y, z, roll, pitch, yaw = pose
    at = Transform.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    reach = farthest(geometry(shape, size), at, point, NoMeshes())
    matrix = as_matrix(at)
    vertices = body.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    sampled = np.linalg.norm(vertices - np.array(point), axis=1).max()
    assert reach is not None
    assert sampled - 1e-9 <= reach
    # An ellipsoid counts by the box around it.
    assert reach <= sampled + (0.2 if shape == "ellipsoid" else 0.005)


class OneMesh:
    """A cube of 2 m, closed or not."""

    def __init__(self, *, watertight: bool) -> None:
        corners = tuple((a, b, c) for a in (-1.0, 1.0) for b in (-1.0, 1.0) for c in (-1.0, 1.0))
        self.mesh = Mesh(
            "cube.stl", "stl", 12, (-1, -1, -1), (1, 1, 1),
            hull=corners, volume=-6.0, hull_volume=8.0, watertight=watertight,
        )  # fmt: skip

    def load(self, uri: Located[str]) -> Mesh | MeshFault:  # noqa: ARG002
        return self.mesh


def test_a_mesh_counts_by_its_own_volume_where_it_is_closed_and_by_its_hull_elsewhere() -> None:
    cube = geometry("mesh", "<uri>cube.stl</uri><scale>0.5 -0.5 2</scale>")
    assert volume_of(cube, OneMesh(watertight=True)) == pytest.approx(3.0)
    assert volume_of(cube, OneMesh(watertight=False)) == pytest.approx(4.0)
    assert farthest(cube, Transform(), (0, 0, 0), OneMesh(watertight=True)) == pytest.approx(
        math.hypot(0.5, 0.5, 2)
    )


@pytest.mark.parametrize("shape", ["mesh", "plane", "heightmap", "empty", "polyline"])
def test_what_is_not_known_has_no_size(shape: str) -> None:
    thing = geometry(shape, "<uri>x.stl</uri>" if shape in ("mesh", "heightmap") else "")
    assert volume_of(thing, NoMeshes()) is None
    assert farthest(thing, Transform(), (0, 0, 0), NoMeshes()) is None


def test_no_size_raises() -> None:
    for size in ("1e300 1e300 1e300", "0 0 0", "-1 -1 -1", "nan inf 1"):
        thing = geometry("box", size)
        for known in (
            volume_of(thing, NoMeshes()),
            farthest(thing, Transform(), (1e300, 0, 0), NoMeshes()),
        ):
            assert known is None or math.isfinite(known)
    assert volume_of(geometry("box", "1e300 1e300 1e300"), NoMeshes()) is None
