"""Random robots in URDF, and conversions of texts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from checker.convert.conversion import Conversion
from checker.convert.sdf_to_urdf import converted_to_urdf
from checker.convert.urdf_to_sdf import sdf_of
from checker.convert.xml_writer import document_text
from checker.formats.sdf.reader import read_sdf
from checker.formats.urdf.description import UrdfDescription, read_description
from checker.formats.urdf.reader import read_urdf
from checker.model.robot import Robot
from checker.physics.mass.inertia import inertial_pose, moments_of
from tests.model.robots import Matrix, as_matrix, document
from tests.model.test_one_robot_two_formats import POSES, Numbers, text

SHAPES = (
    '<box size="0.1 0.2 0.3"/>',
    '<sphere radius="0.1"/>',
    '<cylinder radius="0.1" length="0.3"/>',
    '<mesh filename="package://a/meshes/b.stl" scale="1 1 0.5"/>',
)
MOVING = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True)
class Body:
    """A link and the joint above it; the first link has none."""

    parent: int
    pose: Numbers
    mass: float
    inertial: Numbers
    moments: tuple[float, float, float]
    kind: str
    axis: tuple[float, float, float]
    shape: str
    shape_pose: Numbers


@st.composite
def trees(draw: st.DrawFn, kinds: tuple[str, ...] = (*MOVING, "fixed")) -> list[Body]:
    unit = st.floats(0.5, 1.0)
    return [
        Body(
            draw(st.integers(0, i - 1)) if i else -1,
            draw(POSES),
            draw(st.floats(0.1, 50)),
            draw(POSES),
            (draw(unit), draw(unit), draw(unit)),
            draw(st.sampled_from(kinds)),
            draw(st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, -1), (0.6, 0, 0.8)])),
            draw(st.sampled_from(SHAPES)),
            draw(POSES),
        )
        for i in range(draw(st.integers(1, 6)))
    ]


def origin(pose: Numbers) -> str:
    return f'<origin xyz="{text(pose[:3])}" rpy="{text(pose[3:])}"/>'


def as_urdf(tree: list[Body], more: str = "") -> str:
    parts = [_link(i, body) + (_joint(i, body) if i else "") for i, body in enumerate(tree)]
    return f'<robot name="robot">{"".join(parts)}{more}</robot>'


def keeping_fixed_joints(tree: list[Body]) -> str:
    kept = (i for i, body in enumerate(tree) if i and body.kind == "fixed")
    return "".join(
        f'<gazebo reference="j{i}"><preserveFixedJoint>true</preserveFixedJoint></gazebo>'
        for i in kept
    )


def _link(i: int, body: Body) -> str:
    xx, yy, zz = body.moments
    shape = f"{origin(body.shape_pose)}<geometry>{body.shape}</geometry>"
    return f"""<link name="l{i}"><inertial><mass value="{body.mass!r}"/>{origin(body.inertial)}
    <inertia ixx="{xx!r}" ixy="0.1" ixz="0" iyy="{yy!r}" iyz="-0.05" izz="{zz!r}"/></inertial>
    <visual>{shape}</visual><collision>{shape}</collision></link>"""


def _joint(i: int, body: Body) -> str:
    axis = f'<axis xyz="{text(body.axis)}"/>' if body.kind in MOVING else ""
    limit = '<limit lower="-1.5" upper="0.25" effort="12" velocity="3"/>' if axis else ""
    return f"""<joint name="j{i}" type="{body.kind}"><parent link="l{body.parent}"/>
    <child link="l{i}"/>{origin(body.pose)}{axis}{limit}
    <dynamics damping="0.1" friction="0.2"/></joint>"""


def description_of(urdf: str) -> UrdfDescription:
    return read_description(document(urdf, "robot.urdf"), "robot.urdf", for_rviz=False)


def converted(urdf: str, namespace: str = "") -> Conversion:
    description = description_of(urdf)
    return sdf_of(
        description.robot, description, name="robot", mesh_uri=relative, namespace=namespace
    )


def relative(uri: str) -> str:
    return uri.removeprefix("package://a/")


def absolute(uri: str) -> str:
    return f"package://a/{uri}"


def as_sdf_robot(urdf: str) -> Robot:
    (robot,) = read_sdf(document(document_text(converted(urdf).tree)))
    assert not robot.faults
    return robot


def back_to_urdf(robot: Robot) -> str:
    return document_text(converted_to_urdf(robot, mesh_uri=absolute).tree)


def read_back(urdf: str) -> Robot:
    robot = read_urdf(document(urdf, "robot.urdf"))
    assert not robot.faults
    return robot


def about_centre(robot: Robot, link: str) -> tuple[float, Matrix, Matrix]:
    """Return mass, centre of mass and moments along the robot's axes."""
    part = robot.links_by_name[link]
    pose = as_matrix(inertial_pose(robot, part))
    turn = pose[:3, :3]
    return part.mass, pose[:3, 3], turn @ moments_of(part) @ turn.T


def assert_same_links(robot: Robot, other: Robot, shift: Matrix | None = None) -> None:
    """Check that links weigh the same, stand and have their shapes at the same places.

    Args:
        shift: Pose of the other robot's frame in the first one's; the same by default.
    """
    shift = np.eye(4) if shift is None else shift
    for name, link in robot.links_by_name.items():
        twin = other.links_by_name[name]
        assert_close(shift @ as_matrix(other.pose_of(name)), as_matrix(robot.pose_of(name)))
        mass, centre, moments = about_centre(other, name)
        expected = about_centre(robot, name)
        assert_close(mass, expected[0])
        assert_close(shift[:3, :3] @ centre + shift[:3, 3], expected[1])
        assert_close(shift[:3, :3] @ moments @ shift[:3, :3].T, expected[2])
        for ours, theirs in ((link.collisions, twin.collisions), (link.visuals, twin.visuals)):
            assert len(ours) == len(theirs)
            for one, two in zip(ours, theirs, strict=True):
                assert one.geometry.shape == two.geometry.shape
                at, there = robot.pose_of_part(link, one.pose), other.pose_of_part(twin, two.pose)
                assert_close(shift @ as_matrix(there), as_matrix(at))


def assert_close(value: object, expected: object, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(value, expected, rtol=tolerance, atol=tolerance)
