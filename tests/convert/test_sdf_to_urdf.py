"""A robot in SDF and the URDF made of it are one robot."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.cache import NO_CACHE
from checker.base.parts import WorkerFailed
from checker.convert.sdf_to_urdf import converted_to_urdf
from checker.formats.sdf.reader import read_sdf
from checker.formats.urdf.second_reading import read_again
from checker.model.robot import Robot
from checker.physics.mass.pinocchio_model import pin_model
from tests.convert.trees import absolute, assert_close, assert_same_links, back_to_urdf, read_back
from tests.model.robots import as_matrix, document, sdf
from tests.model.test_one_robot_two_formats import POSES, Numbers, text

MODELS = 14


def root_of(robot: Robot, urdf: Robot) -> str:
    """Return the link of a robot that is the root of its URDF, whose frame is the URDF's."""
    return next(name for name in robot.links_by_name if name not in urdf.tree.ties_above)


def assert_one_robot(robot: Robot, urdf: str) -> None:
    again = read_back(urdf)
    root = root_of(robot, again)
    assert_same_links(robot, again, as_matrix(robot.pose_of(root)))
    for joint in robot.joints:
        if joint.axes and joint.scoped_name in again.joints_by_name:
            twin = again.joints_by_name[joint.scoped_name]
            if twin.axes:
                turn = as_matrix(robot.pose_of(root))[:3, :3]
                here = again.axis_in_model(twin, twin.axes[0])
                assert here is not None
                assert_close(turn @ here, robot.axis_in_model(joint, joint.axes[0]))


@given(st.lists(st.tuples(POSES, POSES, st.sampled_from(["revolute", "prismatic"])), max_size=4))
def test_joints_that_stand_apart_from_their_links(
    parts: list[tuple[Numbers, Numbers, str]],
) -> None:
    inertial = "<inertial><mass>2</mass><pose>0.1 0.2 0.3 0 0 0</pose></inertial>"
    content = f'<link name="l0"><pose>1 2 3 0.1 0.2 0.3</pose>{inertial}</link>'
    for i, (pose, joint, kind) in enumerate(parts, 1):
        content += f"""<link name="l{i}"><pose>{text(pose)}</pose>{inertial}</link>
        <joint name="j{i}" type="{kind}"><parent>l{i - 1}</parent><child>l{i}</child>
        <pose>{text(joint)}</pose><axis><xyz>0.6 0 0.8</xyz></axis></joint>"""
    robot = sdf(content)
    urdf = back_to_urdf(robot)
    assert_one_robot(robot, urdf)
    assert_same_joint_space_inertia(robot, read_back(urdf))


def assert_same_joint_space_inertia(robot: Robot, other: Robot) -> None:
    """Compare the joints alone: a free root has its own frame in each format."""
    first, second = pin_model(robot), pin_model(other)
    ours = [i for i, degree in enumerate(first.degrees) if not degree.free]
    theirs = [i for i, degree in enumerate(second.degrees) if not degree.free]
    assert [first.degrees[i].part for i in ours] == [second.degrees[i].part for i in theirs]
    expected = first.joint_space_inertia()[ours][:, ours]
    assert_close(second.joint_space_inertia()[theirs][:, theirs], expected, 1e-8)


def test_a_joint_with_two_axes_becomes_two() -> None:
    content = """<link name="a"/><link name="b"/><joint name="j" type="universal">
    <parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>
    </joint>"""
    again = read_back(back_to_urdf(sdf(content)))
    assert [joint.name.value for joint in again.joints] == ["j", "j_1"]
    assert [link.name.value for link in again.links] == ["a", "b", "j_frame"]


def test_several_free_links_loops_and_the_world() -> None:
    content = """<link name="a"/><link name="b"/><link name="c"/>
    <joint name="j" type="fixed"><parent>world</parent><child>a</child></joint>
    <joint name="k" type="fixed"><parent>a</parent><child>b</child></joint>
    <joint name="l" type="fixed"><parent>world</parent><child>b</child></joint>
    <joint name="m" type="fixed"><parent>a</parent><child>nobody</child></joint>"""
    done = converted_to_urdf(sdf(content), mesh_uri=absolute)
    joints = {node.get("name"): node.get("type") for node in done.tree.iter("joint")}
    assert joints == {"j": "fixed", "k": "fixed", "c_floating": "floating"}
    said = " ".join(done.notes)
    for part in ("has no parent link", "closes a loop", "which is not a link"):
        assert part in said


def test_colours_are_clamped_and_shared() -> None:
    visual = """<visual name="{}"><geometry><box><size>1 1 1</size></box></geometry>
    <transparency>0.5</transparency><material><diffuse>51000 0 0.5 1</diffuse></material>
    </visual>"""
    content = f'<link name="a">{visual.format("v")}{visual.format("w")}</link>'
    tree = converted_to_urdf(sdf(content), mesh_uri=absolute).tree
    assert [node.get("rgba") for node in tree.iter("color")] == ["1 0 0.5 0.5"]
    assert tree[0].get("name") == "material_1"


def test_shapes_that_urdf_lacks_are_noted() -> None:
    shape = """<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry>
    </collision>"""
    done = converted_to_urdf(sdf(f'<link name="a">{shape}</link>'), mesh_uri=absolute)
    assert not list(done.tree.iter("collision"))
    assert any("plane" in note for note in done.notes)


def models(folder: Path) -> list[Path]:
    return sorted(folder.glob("*/model.sdf"))


def assert_survives(path: Path) -> None:
    robot = read_sdf(document(path.read_text("utf-8"), "model.sdf"))[0]
    urdf = back_to_urdf(robot)
    assert_one_robot(robot, urdf)
    again = read_back(urdf)
    assert sum(link.mass for link in again.links) == pytest.approx(robot.mass)
    assert_same_joint_space_inertia(robot, again)
    readings = read_again([again], NO_CACHE)
    assert not isinstance(readings, WorkerFailed)
    (reading,) = readings
    assert (reading.error, reading.differences) == ("", ())


@pytest.mark.slow
def test_samples(samples: Path) -> None:
    for path in models(samples):
        if not path.parent.name.startswith("broken"):
            assert_survives(path)


def test_real_packages(corpus: Path) -> None:
    found = models(corpus)
    assert len(found) >= MODELS
    for path in found:
        assert_survives(path)
