"""A flattened robot is the robot that it was; its text is that of its author, moved."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings

from checker.formats.sdf.document import sdf_version
from checker.formats.sdf.flattening.names import FlatNames
from checker.model.components import Frame, Link, Model
from checker.model.robot import Robot
from checker.physics.mass.pinocchio_model import pin_model
from tests.effort import examples
from tests.flattening.nested import flattened, nests, read
from tests.model.robots import Matrix, as_matrix

BEFORE, SINCE = ("1.4", "1.5", "1.6"), ("1.7", "1.8", "1.9", "1.11")


def assert_same(text: str, files: dict[str, str]) -> None:
    """Links, masses, poses, axes and the inertia of the joints are what they were."""
    before, after = read(text, files), read(flattened(text, files), {})
    names = FlatNames.from_robot(before)
    assert not after.models
    assert not after.faults
    assert {names.flat_name(link.scoped_name): link.mass for link in before.links} == {
        link.scoped_name: link.mass for link in after.links
    }
    parts: tuple[Link | Frame | Model, ...] = (*before.links, *before.frames, *before.models)
    for part in parts:
        # Before SDF 1.7 nothing can name the place of a model, so nothing stands for it.
        pose = after.pose_of(names.flat_name(part.scoped_name))
        if part not in before.models or sdf_version(before.document) >= (1, 7):
            assert_close(as_matrix(pose), as_matrix(before.pose_of(part.scoped_name)))
    for joint in before.joints:
        same = after.joints_by_name[names.flat_name(joint.scoped_name)]
        ends = (joint.scope + joint.parent.value, joint.scope + joint.child.value)
        assert (same.parent.value, same.child.value) == tuple(map(names.flat_name, ends))
        poses = before.pose_of_joint(joint), after.pose_of_joint(same)
        assert_close(as_matrix(poses[0]), as_matrix(poses[1]))
        for axis, moved in zip(joint.axes, same.axes, strict=True):
            axes = before.axis_in_model(joint, axis), after.axis_in_model(same, moved)
            assert_close(np.array(axes[0]), np.array(axes[1]))
    assert_same_inertia(before, after, names)


def test_a_pose_in_degrees_is_turned() -> None:
    text = """<sdf version="1.6"><model name="robot"><link name="base_link"/>
  <model name="arm"><pose>1 0 0 0 0 0.5</pose>
    <link name="l"><pose degrees="true">0 1 0 0 0 10</pose></link>
  </model>
  <joint name="j" type="fixed"><parent>base_link</parent><child>arm::l</child></joint>
</model></sdf>
"""
    assert_same(text, {})


def assert_same_inertia(before: Robot, after: Robot, names: FlatNames) -> None:
    """Joints may come in another order; of each, the inertia is what it was."""
    nested, flat = pin_model(before), pin_model(after)
    called = [names.flat_name(degree.part) for degree in nested.degrees]
    order = [called.index(degree.part) + degree.number for degree in flat.degrees]
    inertia = nested.joint_space_inertia()[np.ix_(order, order)]
    scale = np.abs(inertia).max()
    assert_close(flat.joint_space_inertia() / scale, inertia / scale)


def assert_close(one: Matrix, other: Matrix) -> None:
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-9)


@settings(max_examples=examples(40))
@given(nests(BEFORE))
def test_a_flat_robot_is_the_nested_one_before_frames(robot: tuple[str, dict[str, str]]) -> None:
    assert_same(*robot)


@settings(max_examples=examples(40))
@given(nests(SINCE))
def test_a_flat_robot_is_the_nested_one_with_frames(robot: tuple[str, dict[str, str]]) -> None:
    assert_same(*robot)
