"""A robot as a scene of MuJoCo: shapes, places, friction, servos and belts."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest
from msgspec import convert, to_builtins
from msgspec.structs import replace

from checker.engine.subject import Subject
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.mjcf.scene import GROUND, Scene, build_scene
from checker.source.text import Located
from tests.model.robots import sdf, urdf
from tests.trial.scenes import (
    BALL,
    INERTIAL,
    assert_placed_as,
    box,
    collision,
    compiled,
    joint,
    link,
    scene_of,
)  # fmt: skip

SHAPES = {
    "box": (box(1, 2, 3), "mjGEOM_BOX", (0.5, 1.0, 1.5)),
    "sphere": ("<sphere><radius>0.4</radius></sphere>", "mjGEOM_SPHERE", (0.4, 0.0, 0.0)),
    "cylinder": (
        "<cylinder><radius>0.4</radius><length>3</length></cylinder>",
        "mjGEOM_CYLINDER",
        (0.4, 1.5, 0.0),
    ),
    "capsule": (
        "<capsule><radius>0.4</radius><length>3</length></capsule>",
        "mjGEOM_CAPSULE",
        (0.4, 1.5, 0.0),
    ),
    "ellipsoid": (
        "<ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid>",
        "mjGEOM_ELLIPSOID",
        (0.1, 0.2, 0.3),
    ),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_simple_shapes_keep_their_kind_and_take_half_sizes(shape: str) -> None:
    text, kind, size = SHAPES[shape]
    model, _ = compiled(scene_of(link("a", collision(text))))
    geom = model.geom("g0")
    assert int(geom.type[0]) == int(getattr(mujoco.mjtGeom, kind))
    np.testing.assert_allclose(geom.size, size)


def test_a_cone_is_a_hull_with_its_tip_up() -> None:
    cone = "<cone><radius>0.5</radius><length>2</length></cone>"
    scene = scene_of(link("a", collision(cone)))
    model, data = compiled(scene)
    geom = model.geom("g0")
    corners = model.mesh_vert[:] @ data.geom_xmat[geom.id].reshape(3, 3).T
    heights = (corners + data.geom_xpos[geom.id])[:, 2] - scene.spawn_height
    assert max(heights) == pytest.approx(1.0, abs=1e-6)
    assert min(heights) == pytest.approx(-1.0, abs=1e-6)
    assert sum(heights > 0.9) == 1


@pytest.mark.parametrize(
    "shape",
    [
        "<plane/>",
        "<heightmap><uri>h.png</uri></heightmap>",
        "<polyline><point>0 0</point></polyline>",
        "<unheard_of/>",
    ],
)
def test_shapes_that_cannot_be_had_are_left_out_and_noted(shape: str) -> None:
    content = link("a", BALL + collision(shape, name="d"))
    scene = scene_of(content)
    assert list(scene.geoms.values()) == ["a"]
    assert "is left out: a." in scene.notes[0]
    assert scene_of(link("a", collision(shape))).unusable


class OneMesh:
    """Gives one mesh for all URIs."""

    def __init__(self, mesh: Mesh | MeshFault) -> None:
        self.mesh = mesh

    def load(self, uri: Located[str]) -> Mesh | MeshFault:
        assert uri.value
        return self.mesh


CUBE = tuple((x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0))
MESH = "<mesh><uri>meshes/a.dae</uri><scale>1 -2 3</scale></mesh>"


def meshed(mesh: Mesh | MeshFault, shape: str = MESH) -> Scene:
    robot = sdf(link("a", collision(shape) + collision(shape, name="d") + BALL))
    return build_scene(replace(robot, meshes=OneMesh(mesh)))


def test_a_mesh_is_its_scaled_hull_written_once_into_the_text() -> None:
    scene = meshed(Mesh("meshes/a.dae", "dae", 12, (0, 0, 0), (1, 1, 1), hull=CUBE))
    assert scene.mjcf.count("vertex=") == 1
    assert "file=" not in scene.mjcf
    model, data = compiled(scene)
    assert model.ngeom == 4
    corners = model.mesh_vert[:] @ data.geom_xmat[1].reshape(3, 3).T + data.geom_xpos[1]
    np.testing.assert_allclose(corners.min(axis=0), (0, -2, scene.spawn_height), atol=1e-6)
    np.testing.assert_allclose(corners.max(axis=0), (1, 0, 3 + scene.spawn_height), atol=1e-6)


def test_a_very_thin_mesh_is_taken() -> None:
    thin = tuple((x, y, z * 1e-4) for x, y, z in CUBE)
    scene = meshed(Mesh("meshes/a.dae", "dae", 12, (0, 0, 0), (1, 1, 1), hull=thin))
    assert compiled(scene)[0].nmesh == 1
    assert not scene.repairs


FLAT = tuple((x, y, 0.0) for x, y, _ in CUBE)


@pytest.mark.parametrize(
    ("mesh", "said", "serious"),
    [
        (MeshFault(MeshTrouble.UNREADABLE, "is empty"), "uses a mesh that is empty", True),
        (Mesh("a.dae", "dae", 2, (0, 0, 0), (1, 1, 0), hull=FLAT), "without volume", True),
        (Mesh("a.dae", "dae", 0, (0, 0, 0), (0, 0, 0)), "without volume", True),
    ],
)
def test_a_mesh_that_cannot_be_had_is_left_out(
    mesh: Mesh | MeshFault, said: str, serious: bool
) -> None:
    scene = meshed(mesh)
    assert compiled(scene)[0].ngeom == 2
    assert [repair.serious for repair in scene.repairs] == [serious] * 2
    assert said in scene.repairs[0].what
    assert scene.repairs[0].what.endswith("and is left out")


_UNKNOWN = (MeshTrouble.NOT_LOOKED_AT, MeshTrouble.UNSUPPORTED, MeshTrouble.MISSING)


@pytest.mark.parametrize("trouble", _UNKNOWN)
def test_without_a_mesh_that_it_may_stand_on_there_is_no_trial(trouble: MeshTrouble) -> None:
    assert meshed(MeshFault(trouble, "was not searched")).unusable.endswith("was not searched")


def test_bodies_stand_where_the_file_poses_the_links() -> None:
    robot = sdf(
        link("a", pose="1 2 3 0.1 0.2 0.3")
        + link("b", pose="-1 0.5 1 0.3 -0.7 2")
        + link("c", pose="0.2 0.1 4 3 1 -2")
        + joint("b")
        + joint("c", parent="b", type="fixed")
    )
    assert_placed_as(robot, build_scene(robot))


def test_poses_may_be_relative_to_joints_and_frames() -> None:
    robot = sdf(
        '<frame name="f"><pose>1 0 0 0 0 1</pose></frame>'
        '<link name="a"><pose relative_to="f">0 1 0 0.5 0 0</pose>'
        '<collision name="c"><pose relative_to="f">0 0 0.5 0 0 0</pose>'
        "<geometry><box><size>1 1 1</size></box></geometry></collision></link>"
        '<link name="b"><pose relative_to="b_joint"/></link>'
        '<joint name="b_joint" type="revolute"><pose relative_to="a">0 0 1 0 0 0.3</pose>'
        "<parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis></joint>",
        "1.9",
    )
    scene = build_scene(robot)
    assert_placed_as(robot, scene)
    _, data = compiled(scene)
    np.testing.assert_allclose(data.geom("g0").xpos, (1, 0, 0.5 + scene.spawn_height), atol=1e-12)


def test_the_lowest_collision_point_is_10_mm_above_the_ground() -> None:
    tilted = collision(box(1, 1, 1), "0.3 0.2 -2 0.4 0.5 0.6")
    scene = scene_of(link("a", tilted, "0 0 5 1 1 1") + link("b", pose="0 0 9 0 0 0"))
    _, data = compiled(scene)
    corners = 0.5 * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    geom = data.geom("g0")
    heights = (corners @ geom.xmat.reshape(3, 3).T + geom.xpos)[:, 2]
    assert min(heights) == pytest.approx(0.01, abs=1e-12)


def surface(friction: str) -> str:
    return f"<surface><friction>{friction}</friction></surface>"


@pytest.mark.parametrize(
    ("stated", "taken"),
    [
        ("", 1.0),
        (surface("<ode><mu>0.4</mu><mu2>0.4</mu2></ode>"), 0.4),
        (surface("<ode><mu>100</mu><mu2>50</mu2></ode>"), 1.5),
        (surface("<ode><mu2>0.4</mu2></ode>"), 1.0),
        (surface("<bullet><friction>0.6</friction></bullet>"), 0.6),
        (surface("<ode><mu>-3</mu></ode>"), 0.0),
        (surface("<ode><mu>nan</mu></ode>"), 1.0),
    ],
)
def test_friction_is_the_robots_and_at_most_1_5(stated: str, taken: float) -> None:
    scene = scene_of(link("a", collision(box(1, 1, 1), rest=stated)))
    model, _ = compiled(scene)
    assert model.geom("g0").friction[0] == taken
    assert model.geom("g0").priority[0] > model.geom(GROUND).priority[0]


def test_friction_of_two_directions_is_noted() -> None:
    anisotropic = surface("<ode><mu>0.5</mu><mu2>1</mu2></ode>")
    scene = scene_of(link("a", collision(box(1, 1, 1), rest=anisotropic)))
    assert scene.notes == (
        "Friction is 0.5 in its first direction and 1 in its second; the trial uses 0.5 for "
        "both: a.",
    )


def test_friction_of_urdf_stands_in_its_gazebo_element() -> None:
    robot = urdf(
        '<link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
        'ixz="0" iyz="0"/></inertial><collision><geometry><sphere radius="1"/></geometry>'
        '</collision></link><gazebo reference="a"><mu1>0.3</mu1><mu2>0.3</mu2></gazebo>'
    )
    assert compiled(build_scene(robot))[0].geom("g0").friction[0] == 0.3


@pytest.mark.parametrize(
    "contact",
    [
        "<collide_bitmask>0</collide_bitmask>",
        "<collide_without_contact>1</collide_without_contact>",
    ],
)
def test_collisions_that_touch_nothing_are_left_out(contact: str) -> None:
    ghost = collision(box(1, 1, 1), rest=f"<surface><contact>{contact}</contact></surface>")
    assert scene_of(link("a", ghost)).unusable


def test_parts_of_the_robot_do_not_collide_in_motion_and_all_do_with_the_ground() -> None:
    low, lower = link("a", pose="0 0 0.05 0 0 0"), link("b")
    scene = scene_of(low + lower)
    model, data = compiled(scene)
    data.qpos[2::7] -= 0.1
    mujoco.mj_forward(model, data)
    ground = model.geom(GROUND).id
    assert {frozenset(pair) for pair in data.contact.geom.tolist()} == {
        frozenset((ground, model.geom("g0").id)),
        frozenset((ground, model.geom("g1").id)),
    }


def test_servos_are_velocity_servos_of_the_joints_asked_for() -> None:
    content = link("a") + link("b") + joint("b") + link("c") + joint("c", type="ball")
    scene = scene_of(content, servos=["b_joint", "c_joint", "nothing", "b_joint"])
    model, data = compiled(scene)
    assert list(scene.actuators) == ["b_joint"]
    assert "Driven joints neither turn nor slide: c_joint, nothing." in scene.notes
    actuator = model.actuator(scene.actuators["b_joint"]).id
    assert model.actuator_trnid[actuator, 0] == model.joint(scene.joints["b_joint"]).id
    model.actuator_gainprm[actuator, 0], model.actuator_biasprm[actuator, 2] = 50.0, -50.0
    data.ctrl[actuator] = 2.0
    mujoco.mj_step(model, data, 2000)
    assert data.qvel[model.joint("j0").dofadr[0]] == pytest.approx(2.0, rel=0.01)


def test_belts_move_what_stands_on_them() -> None:
    block = collision(box(1, 1, 0.2), "0 0 0 0 0 0.5")
    scene = scene_of(link("a", block) + link("b", pose="0 0 2 0 0 0"), belts=["a"])
    assert scene.belts == {"a": ("g0",)}
    model, data = compiled(scene)
    geom = model.geom("g0").id
    backwards = data.geom_xmat[geom].reshape(3, 3).T @ (-1.0, 0.0, 0.0)
    model.geom_surfacevel[geom, :3] = 0.3 * backwards
    mujoco.mj_step(model, data, 1500)
    np.testing.assert_allclose(data.qvel[:2], (0.3, 0.0), atol=0.01)


def test_a_scene_passes_through_json() -> None:
    content = link("a") + link("b") + joint("b") + joint("b", name="again") + link("c", INERTIAL)
    scene = scene_of(content, servos=["b_joint"], belts=["a"])
    assert convert(json.loads(json.dumps(to_builtins(scene))), Scene) == scene


def test_names_of_the_robot_may_hold_anything() -> None:
    evil = '"/&gt;&lt;!-- \\ é'
    content = link("a") + f"<link name='{evil}'>{BALL}</link>"
    content += f"<joint name='{evil}!' type='revolute'><parent>a</parent><child>{evil}</child>"
    scene = scene_of(content + "<axis><xyz>0 0 1</xyz></axis></joint>")
    model, _ = compiled(scene)
    (name,) = scene.joints
    assert model.body(scene.bodies[name.removesuffix("!")]).id == 2
    assert model.joint(scene.joints[name]).id == 1


def test_the_root_is_the_link_that_carries_most_of_the_mass() -> None:
    content = (
        link("stray") + link("foot", BALL + "<inertial><mass>0.1</mass></inertial>")
        + link("body", BALL + INERTIAL) + joint("body", parent="foot", type="fixed")
    )  # fmt: skip
    scene = scene_of(content)
    assert scene.root == "foot"
    assert set(scene.free_joints) == {"stray", "foot"}


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("", "the robot has no links"),
        (link("a", INERTIAL), "the robot has no collision shape that can be used"),
        (link("a") + "<static>true</static>", "the robot is static"),
        (
            link("a") + "<include><uri>model://arm</uri></include>",
            "model://arm is included, but not available",
        ),
    ],
)
def test_without_something_to_drive_there_is_no_scene(content: str, why: str) -> None:
    assert scene_of(content).unusable == why


def test_mujoco_takes_every_robot_of_the_corpus(corpus: Path) -> None:
    taken = 0
    for folder in sorted(corpus.iterdir()):
        if not folder.is_dir():
            continue
        with open_input(folder) as opened:
            for package in opened.packages:
                robots = Subject(package).all(Robot)
                for robot in robots if isinstance(robots, tuple) else ():
                    scene = build_scene(robot)
                    assert not [repair for repair in scene.repairs if repair.serious]
                    assert_placed_as(robot, scene)
                    taken += 1
    assert taken
