"""Volume, hull and box of meshes against closed formulas, in every format and unit."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.model.mesh import Mesh
from checker.physics.mesh import measure
from checker.physics.mesh.reader import read_mesh
from tests.effort import examples
from tests.mesh.files import WRITERS, Triangle, binary_stl, box, cylinder, dae, obj, text_stl
from tests.mesh.normals import BARE, LIT

lengths = st.floats(0.01, 10.0)


def mesh(data: bytes, name: str) -> Mesh:
    read = read_mesh(data, name)
    assert isinstance(read, Mesh), read
    return read


def ball(subdivisions: int) -> list[Triangle]:
    import trimesh

    sphere = trimesh.creation.icosphere(subdivisions=subdivisions, radius=0.5)
    return [tuple(tuple(map(float, point)) for point in each) for each in sphere.triangles]


@pytest.mark.parametrize("suffix", WRITERS)
@settings(max_examples=examples(25))
@given(x=lengths, y=lengths, z=lengths, far=st.floats(-50, 50))
def test_a_box(suffix: str, x: float, y: float, z: float, far: float) -> None:
    read = mesh(WRITERS[suffix](box(x, y, z, (far, 0.0, -far))), f"a.{suffix}")
    assert read.watertight
    assert read.triangles == 12
    assert read.volume == pytest.approx(x * y * z, rel=1e-2)
    assert read.hull_volume == pytest.approx(x * y * z, rel=1e-2)
    assert len(read.hull) == 8
    assert read.centre == pytest.approx((far, 0.0, -far), abs=1e-4)
    moments = (y * y + z * z, 0, 0, x * x + z * z, 0, x * x + y * y)
    assert read.solid.moments(12.0) == pytest.approx(moments, rel=0.02, abs=2e-4)
    assert read.low == pytest.approx((far - x / 2, -y / 2, -far - z / 2), abs=1e-4)
    assert read.high == pytest.approx((far + x / 2, y / 2, -far + z / 2), abs=1e-4)


@settings(max_examples=examples(25))
@given(radius=lengths, length=lengths, sides=st.integers(3, 60))
def test_a_cylinder(radius: float, length: float, sides: int) -> None:
    read = mesh(text_stl(cylinder(radius, length, sides)), "a.stl")
    volume = sides / 2 * radius**2 * math.sin(2 * math.pi / sides) * length
    assert read.volume == pytest.approx(volume, rel=1e-6)
    assert read.hull_volume == pytest.approx(volume, rel=1e-6)
    assert len(read.hull) == 2 * sides
    assert read.degenerate == 0


def test_a_sphere() -> None:
    read = mesh(binary_stl(ball(4)), "a.stl")
    assert read.volume == pytest.approx(math.pi / 6, rel=5e-3)
    assert read.volume == pytest.approx(read.hull_volume, rel=1e-6)


def test_a_hull_of_many_corners_keeps_its_box_and_nearly_its_shape() -> None:
    read = mesh(binary_stl(ball(5)), "a.stl")
    assert len(read.hull) <= 2000
    for axis in range(3):
        assert max(corner[axis] for corner in read.hull) == read.high[axis]
        assert min(corner[axis] for corner in read.hull) == read.low[axis]
    way = [1 / math.sqrt(3)] * 3
    reach = max(sum(a * b for a, b in zip(way, corner, strict=True)) for corner in read.hull)
    assert reach == pytest.approx(0.5, rel=2e-3)


def test_inside_out_has_a_negative_volume_and_the_same_moments() -> None:
    turned = [(a, c, b) for a, b, c in box(1, 1, 1)]
    read = mesh(binary_stl(turned), "a.stl")
    assert read.volume == pytest.approx(-1.0)
    assert read.solid.moments(6.0) == pytest.approx((1, 0, 0, 1, 0, 1), abs=1e-6)


def test_triangles_of_both_senses_have_no_volume() -> None:
    (a, b, c), *others = box(1, 1, 1)
    read = mesh(binary_stl([(a, c, b), *others]), "a.stl")
    assert read.watertight
    assert read.volume is None


def test_a_hole() -> None:
    read = mesh(binary_stl(box(1, 1, 1)[1:]), "a.stl")
    assert not read.watertight
    assert read.volume is None
    assert read.hull_volume == pytest.approx(1.0)
    assert read.solid.moments(6.0) == pytest.approx((1, 0, 0, 1, 0, 1), abs=1e-6)


def test_triangles_without_area_leave_no_hole() -> None:
    a, b = (0.5, 0.5, 0.5), (0.5, 0.5, -0.5)
    read = mesh(binary_stl([*box(1, 1, 1), (a, a, b)]), "a.stl")
    assert read.degenerate == 1
    assert read.watertight
    assert read.volume == pytest.approx(1.0)


@pytest.mark.parametrize(
    "flat", [[((0, 0, 0), (1, 0, 0), (0, 1, 0))], [((0, 0, 0), (1, 1, 1), (2, 2, 2))] * 3]
)
def test_a_flat_mesh_has_no_hull_but_a_box(flat: list[Triangle]) -> None:
    read = mesh(obj(flat), "a.obj")
    assert (read.hull, read.hull_volume, read.volume) == ((), 0.0, None)
    assert len(read.corners) == 8


@pytest.mark.parametrize(
    ("unit", "metres"),
    [("inch", 0.0254), ("millimeter", 0.001), ("centimeter", 0.01), ("meter", 1.0)],
)
def test_the_unit_of_a_collada_file(unit: str, metres: float) -> None:
    data = dae(
        box(1 / metres, 2 / metres, 3 / metres),
        asset=f'<unit name="{unit}" meter="{metres}"/><up_axis>Y_UP</up_axis>',
    )
    read = mesh(data, "a.dae")
    assert read.metres_per_unit == metres
    assert read.volume == pytest.approx(6.0)
    assert read.high == pytest.approx((0.5, 1.0, 1.5))


def test_nodes_place_the_geometry_and_name_the_parts() -> None:
    node = "<translate>5 0 0</translate><scale>2 2 2</scale>"
    read = mesh(dae(box(1, 1, 1), node=node), "a.dae")
    assert read.low == pytest.approx((4, -1, -1))
    assert read.volume == pytest.approx(8.0)
    assert read.parts == ("body",)


def test_a_node_without_a_name_has_that_of_the_node_around_it() -> None:
    show = '<instance_geometry url="#part"/>'
    node = f'<node id="x">{show}</node><node name="lid" id="y">{show}</node>'
    assert mesh(dae(box(1, 1, 1), node=node), "a.dae").parts == ("body", "lid")


@pytest.mark.parametrize("meter", ["0", "-1", "nan", "inf", "one"])
def test_a_unit_that_is_none_counts_as_a_metre(meter: str) -> None:
    read = mesh(dae(box(1, 1, 1), asset=f'<unit meter="{meter}"/>'), "a.dae")
    assert read.volume == pytest.approx(1.0)
    assert meter in read.defects[0]


def test_corners_whose_numbers_fall_together_stay_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    data = binary_stl(ball(2))
    known = mesh(data, "a.stl")
    monkeypatch.setattr(measure, "_MIX", (0, 0, 0))
    assert mesh(data, "a.stl") == known


def test_parts_without_vertex_normals() -> None:
    assert {name: mesh(data, name).bare for name, data in LIT.items()} == dict.fromkeys(LIT, "")
    bare = {name: mesh(data, name).bare for name, data in BARE.items()}
    assert bare == {
        "bare.obj": "has no vertex normals (lines `vn x y z`)",
        "bare.dae": 'has triangles without vertex normals (no <input semantic="NORMAL">)',
        "half.dae": "contains <lines>, which Gazebo reads without normals",
    }


def test_lines_of_a_geometry_that_is_not_shown_do_not_count() -> None:
    lines = '<geometry id="more"><mesh><lines count="0"/></mesh></geometry>'
    end = b"</geometry></library_geometries>"
    data = LIT["box.dae"].replace(end, b"</geometry>" + lines.encode() + b"</library_geometries>")
    assert mesh(data, "a.dae").bare == ""
