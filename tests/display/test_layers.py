"""What each layer shows of a robot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from checker.model.robot import Robot
from checker.physics.mesh.surface import Surface
from checker.report.scene.builder import ITEMS, scene_of
from checker.report.scene.mesh_files import NoSurfaces
from checker.report.scene.scene import DisplayScene, Item, Layer
from checker.source.text import Located
from tests.effort import examples
from tests.model.robots import sdf, urdf

TRIANGLE = Surface(
    np.eye(3, dtype=np.float32),
    np.array([[0, 1, 2]], dtype=np.uint32),
    (0.1, 0.2, 0.3, 1.0),
    np.full((3, 4), 255, dtype=np.uint8),
)


@dataclass(frozen=True)
class Files:
    """Mesh files by their URIs."""

    surfaces: Mapping[str, tuple[Surface, ...] | str]

    def load(self, uri: Located[str]) -> tuple[Surface, ...] | str:
        return self.surfaces.get(uri.value, "does not exist")


def scene(robot: Robot) -> DisplayScene:
    return scene_of(robot, None, Files({"a.dae": (TRIANGLE,), "bad.dae": "is no XML"}))


def items(robot: Robot, layer: Layer) -> list[Item]:
    links = scene(robot).links
    return [item for link in links for item in link.items if item.layer is layer]


def corners(item: Item) -> NDArray[np.float64]:
    """Return the corners of an item in its link's frame."""
    local = np.concatenate([surface.vertices for surface in item.surfaces]).astype(float)
    pose = item.pose
    placed: NDArray[np.float64] = (local * item.scale) @ np.array(pose.rotation).T
    return placed + pose.translation


def shape(geometry: str, more: str = "", kind: str = "visual", pose: str = "0 0 0 0 0 0") -> str:
    return f'<{kind} name="v"><pose>{pose}</pose><geometry>{geometry}</geometry>{more}</{kind}>'


BOX = "<box><size>1 2 3</size></box>"
SMALL = (
    "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
    "</inertial>"
)
MESH = "<mesh><uri>a.dae</uri></mesh>"


def link(content: str, name: str = "a", pose: str = "0 0 0 0 0 0") -> str:
    return f'<link name="{name}"><pose>{pose}</pose>{content}</link>'


@pytest.mark.parametrize(
    ("geometry", "half"),
    [
        (BOX, (0.5, 1.0, 1.5)),
        ("<sphere><radius>2</radius></sphere>", (2, 2, 2)),
        ("<cylinder><radius>2</radius><length>1</length></cylinder>", (2, 2, 0.5)),
        ("<capsule><radius>2</radius><length>1</length></capsule>", (2, 2, 2.5)),
        ("<cone><radius>2</radius><length>1</length></cone>", (2, 2, 0.5)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", (1, 2, 3)),
        ("<plane><normal>0 0 1</normal><size>2 4</size></plane>", (1, 2, 0)),
        ("<plane><normal>1 0 0</normal><size>2 2</size></plane>", (0, 1, 1)),
    ],
)
def test_every_simple_shape_has_its_size(geometry: str, half: tuple[float, ...]) -> None:
    for layer in (Layer.VISUAL, Layer.COLLISION):
        (item,) = items(sdf(link(shape(geometry, kind=str(layer))), "1.9"), layer)
        found = corners(item)
        np.testing.assert_allclose(found.max(axis=0), half, atol=1e-6)
        np.testing.assert_allclose(found.min(axis=0), -np.array(half), atol=1e-6)


@pytest.mark.parametrize(
    "geometry",
    [
        "<box><size>0 1 1</size></box>",
        "<sphere><radius>nan</radius></sphere>",
        "<sphere><radius>-1</radius></sphere>",
        "<cylinder><radius>1e300</radius><length>1</length></cylinder>",
        "<mesh><uri>a.dae</uri><scale>1 0 1</scale></mesh>",
        "<mesh><uri>bad.dae</uri></mesh>",
        "<mesh><uri>gone.dae</uri></mesh>",
        "<mesh><uri>a.dae</uri><submesh><name>lid</name></submesh></mesh>",
        "<mesh/>",
        "<heightmap><uri>a.png</uri></heightmap>",
    ],
)
def test_what_cannot_be_shown_is_said(geometry: str) -> None:
    robot = sdf(link(shape(geometry) + SMALL))
    assert not items(robot, Layer.VISUAL)
    (note,) = scene(robot).notes
    assert "not shown" in note


def test_notes_are_grouped_and_few() -> None:
    many = "".join(shape(f"<mesh><uri>{i // 2}.dae</uri></mesh>") for i in range(200))
    notes = scene(sdf(link(many + SMALL))).notes
    assert len(notes) == 20
    assert notes[0] == "0.dae is not shown: it does not exist"
    assert notes[-1] == "81 more parts are not shown"


def test_a_mesh_looks_as_its_file_has_it_unless_the_model_says_otherwise() -> None:
    (plain,) = items(sdf(link(shape(MESH))), Layer.VISUAL)
    assert plain.surfaces[0].colour == TRIANGLE.colour
    red = "<material><diffuse>1 0 0 0.5</diffuse></material><transparency>0.5</transparency>"
    (painted,) = items(sdf(link(shape(MESH, red))), Layer.VISUAL)
    (surface,) = painted.surfaces
    assert surface.colour == (1.0, 0.0, 0.0, 0.25)
    assert surface.vertex_colours is None
    assert surface.vertices is TRIANGLE.vertices


@pytest.mark.parametrize(
    ("material", "colour"),
    [
        ("", (0.7, 0.7, 0.7, 1.0)),
        ("<material><ambient>0 1 0</ambient></material>", (0.0, 1.0, 0.0, 1.0)),
        ("<material><diffuse>7 -1 inf 1</diffuse></material>", (0.7, 0.7, 0.7, 1.0)),
        ("<material><diffuse>7 -1 0.5 1</diffuse></material>", (1.0, 0.0, 0.5, 1.0)),
        (
            "<material><script><name>Gazebo/RedTransparent</name></script></material>",
            (1.0, 0.0, 0.0, 0.5),
        ),
    ],
)
def test_colours_of_sdf(material: str, colour: tuple[float, ...]) -> None:
    (item,) = items(sdf(link(shape(BOX, material))), Layer.VISUAL)
    assert item.surfaces[0].colour == colour


def test_colours_of_urdf_are_found_by_name() -> None:
    visual = '<visual><geometry><box size="1 1 1"/></geometry>{}</visual>'
    stated = '<material name="green"><color rgba="0 255 0 1"/></material>'
    robot = urdf(
        '<material name="sky"><color rgba="0 0.5 1 0.5"/></material><link name="a">'
        + visual.format('<material name="sky"/>')
        + visual.format(stated)
        + visual.format('<material name="green"/>')
        + "</link>"
    )
    colours = [item.surfaces[0].colour for item in items(robot, Layer.VISUAL)]
    green = (0.0, 1.0, 0.0, 1.0)
    assert colours == [(0.0, 0.5, 1.0, 0.5), green, green]


def test_scales_may_mirror() -> None:
    (item,) = items(
        sdf(link(shape("<mesh><uri>a.dae</uri><scale>1 -2 3</scale></mesh>"))), Layer.VISUAL
    )
    assert item.scale == (1.0, -2.0, 3.0)


def test_collisions_are_see_through_in_one_colour() -> None:
    content = shape(MESH, kind="collision") + shape(BOX, kind="collision")
    found = items(sdf(link(content)), Layer.COLLISION)
    assert len({item.surfaces[0].colour for item in found}) == 1
    assert all(item.surfaces[0].colour[3] < 1.0 for item in found)
    assert all(item.surfaces[0].vertex_colours is None for item in found)


def inertial(mass: float, moments: Mapping[str, float], pose: str = "0 0 0 0 0 0") -> str:
    said = "".join(f"<{name}>{value!r}</{name}>" for name, value in moments.items())
    return f"<inertial><pose>{pose}</pose><mass>{mass!r}</mass><inertia>{said}</inertia></inertial>"


EDGES = st.floats(0.01, 10.0)


@settings(max_examples=examples(40))
@given(EDGES, EDGES, EDGES, st.floats(0.01, 100.0), st.tuples(*[st.floats(-3, 3)] * 3))
def test_the_box_of_an_inertia_is_the_box_that_has_it(
    a: float, b: float, c: float, mass: float, turn: tuple[float, ...]
) -> None:
    squares = a * a, b * b, c * c
    xx, yy, zz = (mass * (sum(squares) - own) / 12 for own in squares)
    pose = f"0.1 0.2 0.3 {turn[0]} {turn[1]} {turn[2]}"
    around = shape("<sphere><radius>20</radius></sphere>")
    robot = sdf(link(inertial(mass, {"ixx": xx, "iyy": yy, "izz": zz}, pose) + around))
    (item,) = items(robot, Layer.INERTIA)
    assert sorted(item.scale) == pytest.approx(sorted((a, b, c)), rel=1e-4)
    assert item.pose.translation == (0.1, 0.2, 0.3)
    # Second moments of the corners, in the link's frame, are those of the tensor up to a factor.
    spread = corners(item) - item.pose.translation
    (stated,) = robot.links
    assert stated.inertial is not None
    rotation = np.array(stated.inertial.pose.transform.rotation)
    tensor = rotation @ np.diag([xx, yy, zz]) @ rotation.T
    covariance = spread.T @ spread / len(spread)
    again = mass / 3 * (np.trace(covariance) * np.eye(3) - covariance)
    np.testing.assert_allclose(again, tensor, rtol=0, atol=1e-4 * np.abs(tensor).max())


@pytest.mark.parametrize(
    "moments",
    [
        {"ixx": 1.0, "iyy": 1.0, "izz": 3.0},
        {"ixx": -1.0, "iyy": 1.0, "izz": 1.0},
        {"ixx": 0.0, "iyy": 0.0, "izz": 0.0},
        {"ixx": math.inf, "iyy": 1.0, "izz": 1.0},
    ],
)
def test_an_inertia_that_no_body_has_has_no_box(moments: dict[str, float]) -> None:
    assert not items(sdf(link(inertial(1.0, moments))), Layer.INERTIA)
    assert not items(sdf(link(inertial(-1.0, {"ixx": 1.0}))), Layer.INERTIA)


def test_a_box_that_would_hide_the_robot_is_said_and_not_shown() -> None:
    round_ = {"ixx": 1.0, "iyy": 1.0, "izz": 1.0}
    robot = sdf(link(inertial(0.006, round_) + shape("<box><size>1 1 1</size></box>")))
    assert not items(robot, Layer.INERTIA)
    said = "the inertia of link 'a' is that of a box of 31.6 m: it is not shown"
    assert scene(robot).notes == (said,)


def test_a_rod_has_a_thin_box() -> None:
    rod = inertial(12.0, {"ixx": 0.0, "iyy": 1.0, "izz": 1.0})
    (item,) = items(sdf(link(rod + shape(BOX))), Layer.INERTIA)
    assert max(item.scale) == pytest.approx(1.0)
    assert 0.0 < min(item.scale) < 0.01


def test_each_link_has_a_frame_of_three_colours() -> None:
    robot = sdf(link(shape(BOX)) + link("", "b", "5 0 0 0 0 0"))
    first, second = items(robot, Layer.FRAME)
    assert first.pose == second.pose
    assert len({surface.colour for surface in first.surfaces}) == 3
    assert 0.0 < first.scale[0] < 1.0


JOINT = """
<joint name="j" type="{type}"><pose>0 0 0.5 0 0 0</pose><parent>a</parent><child>b</child>
<axis><xyz>0 1 0</xyz></axis>{more}</joint>
"""


def two_links(type: str = "revolute", more: str = "") -> Robot:
    tilted = link("", "b", "1 0 0 0 0 1.5707963267948966")
    return sdf(link(shape(BOX)) + tilted + JOINT.format(type=type, more=more), "1.7")


def test_an_arrow_points_along_the_axis_and_hangs_on_the_child() -> None:
    found = scene(two_links())
    (item,) = (each for each in found.links[1].items if each.layer is Layer.JOINT)
    assert item.element == "sdf/model[robot]/joint[j]"
    tip = max(corners(item), key=lambda corner: math.dist(corner, item.pose.translation))
    along = (tip - item.pose.translation) / math.dist(tip, item.pose.translation)
    np.testing.assert_allclose(along, (0, 1, 0), atol=1e-6)
    np.testing.assert_allclose(item.pose.translation, (0, 0, 0.5), atol=1e-12)


def test_each_axis_has_an_arrow_and_fixed_joints_have_none() -> None:
    second = "<axis2><xyz>1 0 0</xyz></axis2>"
    assert len(items(two_links("universal", second), Layer.JOINT)) == 2
    assert len(items(two_links("ball"), Layer.JOINT)) == 1
    assert not items(two_links("fixed"), Layer.JOINT)


def test_balls_are_as_the_masses_and_the_cross_stands_at_the_centre_of_mass() -> None:
    round_ = {"ixx": 1.0, "iyy": 1.0, "izz": 1.0}
    heavy = inertial(8.0, round_, "0 0 1 0 0 0")
    robot = sdf(link(heavy + shape(BOX)) + link(inertial(1.0, round_), "b", "9 0 0 0 0 0"))
    one, whole, other = items(robot, Layer.MASS)
    assert one.scale[0] == pytest.approx(2 * other.scale[0])
    assert one.pose.translation == (0.0, 0.0, 1.0)
    assert one.element == "sdf/model[robot]/link[a]/inertial"
    np.testing.assert_allclose(whole.pose.translation, (1.0, 0.0, 8 / 9), atol=1e-12)
    assert whole.element == "sdf/model[robot]"
    assert "9 kg" in whole.name


CAMERA = """
<sensor name="eye" type="camera"><pose>1 0 0 0 0 0</pose><camera>
<horizontal_fov>{fov}</horizontal_fov><image><width>200</width><height>100</height></image>
<clip><near>0.01</near><far>{far}</far></clip></camera></sensor>
"""
LIDAR = """
<sensor name="scan" type="gpu_lidar"><lidar><scan>
<horizontal><samples>640</samples><min_angle>{left}</min_angle><max_angle>{right}</max_angle>
</horizontal>
<vertical><samples>{rows}</samples><min_angle>{low}</min_angle><max_angle>{high}</max_angle>
</vertical></scan><range><min>0.1</min><max>{far}</max></range></lidar></sensor>
"""


def test_a_camera_sees_a_pyramid_as_wide_as_its_angles() -> None:
    (item,) = items(sdf(link(shape(BOX) + CAMERA.format(fov=math.pi / 2, far=0.5))), Layer.VIEW)
    assert item.pose.translation == (1.0, 0.0, 0.0)
    sides, edges = item.surfaces
    far = sides.vertices[1:]
    np.testing.assert_allclose(np.abs(far[:, 1]), far[:, 0], rtol=1e-6)
    np.testing.assert_allclose(np.abs(far[:, 2]), far[:, 0] / 2, rtol=1e-6)
    assert np.linalg.norm(far, axis=1) == pytest.approx(0.5)
    assert sides.colour[3] < 1.0 == edges.colour[3]


def test_views_end_near_the_robot() -> None:
    content = shape(BOX) + CAMERA.format(fov=1, far=300)
    content += LIDAR.format(left=-3, right=3, rows=1, low=0, high=0, far=300)
    size = math.sqrt(14) / 2
    eye, scan = items(sdf(link(content)), Layer.VIEW)
    assert np.linalg.norm(eye.surfaces[0].vertices, axis=1).max() == pytest.approx(1.5 * size)
    assert np.linalg.norm(scan.surfaces[0].vertices, axis=1).max() == pytest.approx(2 * size)


def test_a_lidar_scans_between_its_limits() -> None:
    content = LIDAR.format(left=-1, right=0.5, rows=16, low=-0.2, high=0.3, far=2)
    (item,) = items(sdf(link(shape(BOX) + content)), Layer.VIEW)
    x, y, z = item.surfaces[0].vertices.T.astype(float)
    ends = np.hypot(np.hypot(x, y), z) > 0.0
    azimuth, elevation = np.arctan2(y, x)[ends], np.arcsin(z[ends] / 2)
    assert (azimuth.min(), azimuth.max()) == pytest.approx((-1, 0.5))
    assert (elevation.min(), elevation.max()) == pytest.approx((-0.2, 0.3))


@pytest.mark.parametrize(
    "sensor",
    [
        CAMERA.format(fov="nan", far=1),
        CAMERA.format(fov=1, far="-1"),
        LIDAR.format(left="-inf", right=3, rows=1, low=0, high=0, far=3),
        LIDAR.format(left=-3, right=3, rows=0, low=0, high=0, far=3),
        '<sensor name="i" type="imu"/>',
    ],
)
def test_what_sees_nothing_has_no_view(sensor: str) -> None:
    assert not items(sdf(link(shape(BOX) + sensor)), Layer.VIEW)


@pytest.mark.parametrize("far", ["inf", "1e300"])
def test_views_without_end_are_cut(far: str) -> None:
    (item,) = items(sdf(link(shape(BOX) + CAMERA.format(fov=6, far=far))), Layer.VIEW)
    assert np.isfinite(item.surfaces[0].vertices).all()


def test_poses_relative_to_other_frames_are_followed() -> None:
    turned = '<visual name="v"><pose relative_to="b">0 0 1 0 0 0</pose><geometry>'
    robot = sdf(
        link(f"{turned}{BOX}</geometry></visual>") + link("", "b", "1 0 0 1.5707963267948966 0 0"),
        "1.7",
    )
    (item,) = items(robot, Layer.VISUAL)
    np.testing.assert_allclose(item.pose.translation, (1, -1, 0), atol=1e-12)


def test_links_without_a_place_are_left_out() -> None:
    lost = '<link name="lost"><pose relative_to="nowhere">0 0 0 0 0 0</pose></link>'
    found = scene(sdf(link(shape(BOX)) + lost, "1.7"))
    assert [each.name for each in found.links] == ["a"]
    assert found.notes == ("link 'lost' is not shown: its place is not known",)


def test_a_layer_has_an_end() -> None:
    robot = sdf(link("".join(shape(BOX) for _ in range(ITEMS + 5))))
    assert len(items(robot, Layer.VISUAL)) == ITEMS
    assert scene(robot).notes == (f"only the first {ITEMS} parts of the layer visual are shown",)


def test_a_robot_without_meshes_at_hand_shows_the_rest() -> None:
    found = scene_of(sdf(link(shape(MESH) + shape(BOX))), None, NoSurfaces())
    assert found.notes == ("a.dae is not shown: it was not read",)
    assert [item.layer for item in found.links[0].items].count(Layer.VISUAL) == 1
