"""Joints of SDF and URDF as joints of MuJoCo."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from checker.physics.trial.mjcf.scene import Scene, build_scene
from tests.model.robots import sdf, urdf
from tests.trial.scenes import INERTIAL, compiled, joint, link, scene_of

HINGE, SLIDE, BALL = (
    mujoco.mjtJoint.mjJNT_HINGE,
    mujoco.mjtJoint.mjJNT_SLIDE,
    mujoco.mjtJoint.mjJNT_BALL,
)
AXIS = "<axis><xyz>0 0 1</xyz></axis>"
AXES = AXIS + "<axis2><xyz>1 0 0</xyz></axis2>"


def jointed(type: str, rest: str = "", parent: str = "a") -> Scene:
    return scene_of(link("a") + link("b") + joint("b", parent=parent, type=type, rest=rest))


def types_of(scene: Scene) -> list[int]:
    model, _ = compiled(scene)
    return [int(type) for type in model.jnt_type if type != mujoco.mjtJoint.mjJNT_FREE]


@pytest.mark.parametrize(
    ("type", "rest", "types"),
    [
        ("fixed", "", []),
        ("revolute", AXIS, [HINGE]),
        ("continuous", AXIS, [HINGE]),
        ("prismatic", AXIS, [SLIDE]),
        ("ball", "", [BALL]),
        ("universal", AXES, [HINGE, HINGE]),
        ("revolute2", AXES, [HINGE, HINGE]),
    ],
)
def test_types_that_move(type: str, rest: str, types: list[int]) -> None:
    scene = jointed(type, rest)
    assert types_of(scene) == [int(each) for each in types]
    assert not scene.notes
    assert not scene.repairs


def test_a_ball_joint_has_no_damping() -> None:
    """Gazebo reads none: the ball of a caster would brake the robot."""
    axis = AXIS.replace("</axis>", "<dynamics><damping>10</damping></dynamics></axis>")
    model, _ = compiled(jointed("ball", axis))
    assert not model.dof_damping.any()


@pytest.mark.parametrize("type", ["screw", "gearbox", "glued", ""])
def test_other_types_are_held_fixed(type: str) -> None:
    scene = jointed(type, AXIS)
    assert types_of(scene) == []
    assert scene.notes == (f"Joints of type {type!r} are held fixed: b_joint.",)
    assert not scene.joints
    assert scene.welded == {"a": "a", "b": "a", "world": "world"}


def limited(low: str, high: str) -> str:
    return f"<axis><xyz>0 0 1</xyz><limit><lower>{low}</lower><upper>{high}</upper></limit></axis>"


def test_limits() -> None:
    model, _ = compiled(jointed("revolute", limited("-0.5", "1.25")))
    np.testing.assert_array_equal(model.joint("j0").range, (-0.5, 1.25))
    assert model.joint("j0").limited[0]


@pytest.mark.parametrize(("low", "high"), [("-1e16", "1e16"), ("-inf", "inf"), ("-1e7", "1e7")])
def test_limits_that_are_none(low: str, high: str) -> None:
    model, _ = compiled(jointed("revolute", limited(low, high)))
    assert not model.joint("j0").limited[0]


def test_a_limit_on_one_side() -> None:
    model, _ = compiled(jointed("prismatic", limited("-inf", "0.3")))
    np.testing.assert_array_equal(model.joint("j0").range, (-1e6, 0.3))


def test_limits_that_leave_no_range_hold_the_joint() -> None:
    scene = jointed("revolute", limited("0", "0"))
    assert types_of(scene) == []
    assert scene.notes == ("Joints whose limits allow no range are held fixed: b_joint.",)
    assert not scene.repairs


def test_limits_the_wrong_way_round_are_left_out() -> None:
    scene = jointed("revolute", limited("1", "-1"))
    (repair,) = scene.repairs
    assert repair.serious
    assert repair.part == "b_joint"
    assert repair.what == (
        "has a lower limit of 1 that is not below its upper limit of -1; both are left out"
    )
    assert not compiled(scene)[0].joint("j0").limited[0]


def test_a_start_beyond_the_limits_is_noted() -> None:
    scene = jointed("revolute", limited("0.5", "1"))
    assert scene.notes == ("Joints whose limits exclude 0 start at the nearest limit: b_joint.",)


def test_damping_friction_and_spring() -> None:
    dynamics = (
        "<dynamics><damping>0.3</damping><friction>0.2</friction>"
        "<spring_stiffness>7</spring_stiffness><spring_reference>0.4</spring_reference></dynamics>"
    )
    model, _ = compiled(jointed("revolute", f"<axis><xyz>0 0 1</xyz>{dynamics}</axis>"))
    joint = model.joint("j0")
    degree = joint.dofadr[0]
    assert model.dof_damping[degree] == 0.3
    assert model.dof_frictionloss[degree] == 0.2
    assert model.jnt_stiffness[joint.id].flat[0] == 7.0
    assert model.qpos_spring[joint.qposadr[0]] == 0.4


def test_springs_of_urdf_are_in_its_gazebo_tags_and_the_last_one_counts() -> None:
    """The values are those that libsdformat 12 reads from the same file."""
    bodies = "".join(
        f'<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
        'ixz="0" iyz="0"/></inertial>'
        '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
        "</link>"
        for name in "ab"
    )
    robot = urdf(
        f'{bodies}<joint name="b_joint" type="continuous"><parent link="a"/><child link="b"/>'
        '<axis xyz="0 0 1"/></joint>'
        '<gazebo reference="b_joint"><springStiffness>5</springStiffness>'
        "<springReference>0.3</springReference></gazebo>"
        '<gazebo reference="b_joint"><springStiffness>9</springStiffness></gazebo>'
        '<gazebo reference="b"><springStiffness>70</springStiffness></gazebo>'
    )
    model, _ = compiled(build_scene(robot))
    joint = model.joint("j0")
    assert model.jnt_stiffness[joint.id].flat[0] == 9.0
    assert model.qpos_spring[joint.qposadr[0]] == 0.3


@pytest.mark.parametrize("value", ["-1", "nan"])
def test_dynamics_that_would_drive_the_joint_are_none(value: str) -> None:
    dynamics = f"<dynamics><damping>{value}</damping><friction>{value}</friction></dynamics>"
    model, _ = compiled(jointed("revolute", f"<axis><xyz>0 0 1</xyz>{dynamics}</axis>"))
    assert not model.dof_damping.any()
    assert not model.dof_frictionloss.any()


def test_effort_limits_are_not_in_the_model() -> None:
    effort = "<axis><xyz>0 0 1</xyz><limit><effort>3</effort></limit></axis>"
    content = link("a") + link("b") + joint("b", rest=effort)
    model, _ = compiled(scene_of(content, servos=["b_joint"]))
    assert not model.actuator_forcelimited.any()
    assert not model.jnt_actfrclimited.any()


TURNED = "<axis><xyz>0 0 1</xyz>{}</axis>"


@pytest.mark.parametrize(
    ("version", "text", "expected"),
    [
        ("1.6", "<axis><xyz>0 0 1</xyz></axis>", "joint"),
        (
            "1.6",
            "<axis><xyz>0 0 1</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>",
            "model",
        ),
        ("1.4", "<axis><xyz>0 0 1</xyz></axis>", "model"),
        ("1.7", '<axis><xyz expressed_in="__model__">0 0 1</xyz></axis>', "model"),
        ("1.7", '<axis><xyz expressed_in="a">0 0 1</xyz></axis>', "a"),
    ],
)
def test_axis_and_anchor(version: str, text: str, expected: str) -> None:
    at = "<pose>0.1 0.2 0.3 0.7 0 0</pose>"
    robot = sdf(
        link("a", pose="0 0 1 0 0.5 0")
        + link("b", pose="1 0 0 0 0 0.4")
        + joint("b", rest=at + text),
        version,
    )
    frames = {"joint": "b_joint", "model": "__model__", "a": "a"}
    frame, place = robot.pose_of(frames[expected]), robot.pose_of("b_joint")
    assert frame is not None
    assert place is not None
    scene = build_scene(robot)
    _, data = compiled(scene)
    np.testing.assert_allclose(data.joint("j0").xaxis, frame.rotate((0, 0, 1)), atol=1e-12)
    anchor = np.add(place.translation, (0, 0, scene.spawn_height))
    np.testing.assert_allclose(data.joint("j0").xanchor, anchor, atol=1e-12)


def test_urdf_anchors_joints_in_the_parent() -> None:
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        '</inertial><collision><geometry><sphere radius="0.1"/></geometry></collision>'
    )
    robot = urdf(
        f'<link name="a">{inertial}</link><link name="b">{inertial}</link>'
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/>'
        '<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/></joint>'
    )
    scene = build_scene(robot)
    _, data = compiled(scene)
    np.testing.assert_allclose(data.joint("j0").xaxis, (0, 1, 0), atol=1e-12)
    np.testing.assert_allclose(data.joint("j0").xanchor, (1, 2, 3 + scene.spawn_height))


def test_two_axes_turn_from_parent_to_child() -> None:
    scene = jointed("universal", AXES)
    model, data = compiled(scene)
    first, second = model.joint("j0"), model.joint("j0_2")
    data.qpos[first.qposadr[0]] = np.pi / 2
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(data.joint("j0").xaxis, (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(data.xaxis[second.id], (0, 1, 0), atol=1e-12)


@pytest.mark.parametrize(
    ("axis", "what", "serious"),
    [
        ("<axis><xyz>0 0 0</xyz></axis>", "has an axis of length 0", True),
        ("", "lacks an axis", False),
    ],
)
def test_axes_without_direction_hold_the_joint(axis: str, what: str, serious: bool) -> None:
    scene = jointed("revolute", axis or "<pose/>")
    (repair,) = scene.repairs
    assert repair.what == f"{what} and is held fixed about it"
    assert repair.serious is serious
    assert types_of(scene) == []


def test_links_tied_to_the_world_are_not_free() -> None:
    scene = scene_of(link("a") + link("b") + joint("a", parent="world", type="fixed") + joint("b"))
    model, data = compiled(scene)
    assert not scene.free_joints
    assert scene.root == "a"
    assert scene.welded["a"] == "world"
    mujoco.mj_step(model, data, 500)
    assert data.body(scene.bodies["a"]).xpos[2] == scene.spawn_height


def test_links_that_hang_on_nothing_are_free_each() -> None:
    scene = scene_of(link("a") + link("b", pose="3 0 0 0 0 0"))
    assert set(scene.free_joints) == {"a", "b"}
    assert compiled(scene)[0].nv == 12


def test_weightless_links_float() -> None:
    scene = scene_of(link("a") + link("b", INERTIAL + "<gravity>false</gravity>", "3 0 0 0 0 0"))
    model, data = compiled(scene)
    mujoco.mj_step(model, data, 500)
    assert data.body(scene.bodies["b"]).xpos[2] == pytest.approx(scene.spawn_height)


def test_of_two_joints_with_one_name_the_first_is_found() -> None:
    scene = scene_of(
        link("a")
        + link("b")
        + link("c", pose="0 0 2 0 0 0")
        + joint("b", name="j")
        + joint("c", name="j")
    )
    model, _ = compiled(scene)
    assert model.njnt == 3
    body = model.jnt_bodyid[model.joint(scene.joints["j"]).id]
    assert body == model.body(scene.bodies["b"]).id


def test_a_loop_is_cut_and_named() -> None:
    content = link("a") + link("b") + link("c") + joint("b") + joint("c")
    scene = scene_of(content + joint("c", parent="b", name="second"))
    (repair,) = scene.repairs
    assert repair.part == "second"
    assert repair.what == "connects b with c, which already has a parent, and is left out"
    assert not repair.serious
    assert ("b", "c") in scene.tied
    compiled(scene)


def test_links_that_hang_on_one_another_in_a_circle() -> None:
    content = link("a") + link("b") + joint("b") + joint("a", parent="b")
    scene = scene_of(content + link("c") + joint("c", parent="c"))
    assert {repair.part for repair in scene.repairs} == {"a_joint", "c_joint"}
    assert set(scene.free_joints) == {"a", "c"}
    compiled(scene)


def test_a_joint_with_an_unknown_end_is_left_out() -> None:
    scene = scene_of(link("a") + link("b") + joint("b", parent="nowhere"))
    (repair,) = scene.repairs
    assert repair.what == "connects 'nowhere', which is not a link, and is left out"
    assert set(scene.free_joints) == {"a", "b"}
