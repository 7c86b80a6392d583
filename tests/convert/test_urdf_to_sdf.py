"""A robot in URDF and the SDF made of it are one robot."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from hypothesis import given, settings

from checker.model.robot import Robot
from checker.physics.mass.pinocchio_model import PinModel, pin_model
from tests.convert.trees import (
    MOVING,
    Body,
    as_sdf_robot,
    as_urdf,
    assert_close,
    assert_same_links,
    back_to_urdf,
    converted,
    description_of,
    keeping_fixed_joints,
    read_back,
    trees,
)
from tests.effort import examples
from tests.model.robots import Matrix, as_matrix


def joint_space_inertia(model: PinModel) -> tuple[list[tuple[str, int]], Matrix]:
    """Return what each row is, and the matrix, in an order that does not depend on the format."""
    keys = [(degree.part, degree.number) for degree in model.degrees]
    order = sorted(range(len(keys)), key=keys.__getitem__)
    return [keys[i] for i in order], model.joint_space_inertia()[np.ix_(order, order)]


def assert_same_dynamics(robot: Robot, other: Robot) -> None:
    first, second = pin_model(robot), pin_model(other)
    ours, theirs = joint_space_inertia(first), joint_space_inertia(second)
    assert ours[0] == theirs[0]
    assert_close(theirs[1], ours[1])
    assert_close(pin.computeTotalMass(second.model), pin.computeTotalMass(first.model))
    centres = [
        pin.centerOfMass(each.model, each.model.createData(), pin.neutral(each.model))
        for each in (first, second)
    ]
    assert_close(centres[1], centres[0])


def assert_same_axes(robot: Robot, other: Robot) -> None:
    for joint in robot.joints:
        twin = other.joints_by_name.get(joint.scoped_name)
        if joint.type.value == "fixed":
            continue
        assert twin is not None
        axis, same = joint.axes[0], twin.axes[0]
        assert_close(other.axis_in_model(twin, same), robot.axis_in_model(joint, axis))
        place = as_matrix(other.pose_of_joint(twin))[:3, 3]
        assert_close(place, as_matrix(robot.pose_of(joint.child.value))[:3, 3])
        endless = joint.type.value == "continuous"
        limits = (-np.inf, np.inf) if endless else (axis.lower.value, axis.upper.value)
        assert (same.lower.value, same.upper.value) == limits
        assert (same.effort.value, same.velocity.value) == (12, 3)
        assert (same.damping.value, same.friction.value) == (0.1, 0.2)


@given(trees())
def test_the_same_links_when_fixed_joints_are_kept(tree: list[Body]) -> None:
    urdf = as_urdf(tree, keeping_fixed_joints(tree))
    source, robot = description_of(urdf).robot, as_sdf_robot(urdf)
    assert set(robot.links_by_name) == set(source.links_by_name)
    assert_same_links(source, robot)
    assert_same_axes(source, robot)
    assert_same_dynamics(source, robot)


@given(trees())
def test_the_same_dynamics_when_they_are_lumped(tree: list[Body]) -> None:
    source, robot = description_of(as_urdf(tree)).robot, as_sdf_robot(as_urdf(tree))
    moving = sum(body.kind in MOVING for body in tree[1:])
    assert (len(robot.links), len(robot.joints)) == (moving + 1, moving)
    assert_same_axes(source, robot)
    assert_same_dynamics(source, robot)


@given(trees())
def test_lumped_links_are_where_the_conversion_says(tree: list[Body]) -> None:
    urdf = as_urdf(tree)
    source, conversion = description_of(urdf).robot, converted(urdf)
    for name, lumped in conversion.lumped.items():
        base = as_matrix(source.pose_of(lumped.link))
        assert_close(base @ as_matrix(lumped.pose), as_matrix(source.pose_of(name)))


@given(trees())
def test_shapes_stay_where_they_are_when_their_links_are_lumped(tree: list[Body]) -> None:
    source, robot = description_of(as_urdf(tree)).robot, as_sdf_robot(as_urdf(tree))
    for kind in ("collisions", "visuals"):
        before = [(link, shape) for link in source.links for shape in getattr(link, kind)]
        after = [(link, shape) for link in robot.links for shape in getattr(link, kind)]
        assert len(before) == len(after)
        here = sorted(_place(source, *each) for each in before)
        assert_close(sorted(_place(robot, *each) for each in after), here, 1e-8)
        for link in robot.links:
            names = [shape.name.value for shape in getattr(link, kind)]
            assert len(set(names)) == len(names)


def _place(robot: Robot, link: object, shape: object) -> tuple[float, ...]:
    pose = as_matrix(robot.pose_of_part(link, shape.pose))  # type: ignore[arg-type, attr-defined]
    # Where first, so that sorting puts a shape beside its twin; then which way it is turned.
    return (*np.round(pose[:3, 3], 9), *pose[:3, :3].flatten())


@settings(max_examples=examples(40))
@given(trees())
def test_there_and_back(tree: list[Body]) -> None:
    source, robot = description_of(as_urdf(tree)).robot, as_sdf_robot(as_urdf(tree))
    urdf = back_to_urdf(robot)
    again = read_back(urdf)
    assert_same_links(robot, again)
    assert_same_axes(source, again)
    assert_same_dynamics(source, again)
    assert_parsed_by_pinocchio(source, urdf)


def assert_parsed_by_pinocchio(source: Robot, urdf: str) -> None:
    """Check that Pinocchio's own reader of URDF finds the same dynamics."""
    model = pin.buildModelFromXML(urdf.partition("?>")[2], pin.JointModelFreeFlyer())
    data = model.createData()
    upper = np.triu(pin.crba(model, data, pin.neutral(model)))
    inertia = upper + np.triu(upper, 1).T
    names, ours = joint_space_inertia(pin_model(source))
    order = [_column(model, part, number) for part, number in names]
    assert_close(inertia[np.ix_(order, order)], ours)


def _column(model: pin.Model, part: str, number: int) -> int:
    joint = model.getJointId(part) if model.existJointName(part) else 1
    return int(model.idx_vs[joint]) + number
