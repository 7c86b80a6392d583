"""A robot as a model of Pinocchio, joint by joint."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.model.components import Link
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.physics.mass.inertia import inertial_pose, se3, spatial_inertia
from checker.physics.mass.mechanism import (
    Freedom,
    Motion,
    SpanningTree,
    motions_of,
    spanning_tree_of,
)

if TYPE_CHECKING:
    import numpy as np
    import pinocchio as pin
    from numpy.typing import NDArray

    Matrix = NDArray[np.float64]


class Degree(Record):
    """One degree of freedom.

    Attributes:
        part: Scoped name of the joint; of a free robot, of the link that has no parent.
        number: The number of the joint's axis, from 0; of a ball x, y, z of its turn rate; of a
            free link x, y, z of its velocity, then of its turn rate.
        free: Whether it is one of a free link.
    """

    part: str
    number: int
    free: bool = False


class PinModel(Record, eq=False):
    """A robot in Pinocchio's words; its configuration `neutral` is the pose that it starts in.

    Each joint's frame stands at the joint, along the axes of its child link.

    Attributes:
        model: Its frames of type BODY are the links.
        degrees: What each velocity of the model is, in order.
        notes: What is left out or held fixed, as whole sentences.
    """

    model: pin.Model
    degrees: tuple[Degree, ...]
    notes: tuple[str, ...]

    def joint_space_inertia(self) -> Matrix:
        """Return the inertia of the joints in the starting pose; its rows are `degrees`.

        A free link's velocity counts along the robot's axes, its turn rate about its own, as in
        MuJoCo's `mj_fullM`; Pinocchio itself takes both along the link's own. kg, kg·m, kg·m².
        """
        import numpy as np
        import pinocchio as pin

        data = self.model.createData()
        upper = np.triu(pin.crba(self.model, data, pin.neutral(self.model)))
        inertia = upper + np.triu(upper, 1).T
        for number, degree in enumerate(self.degrees):
            if degree.free and degree.number == 0:
                joint = self.model.getJointId(_free(degree.part))
                turn = self.model.jointPlacements[joint].rotation
                linear = slice(number, number + 3)
                inertia[linear] = turn @ inertia[linear]
                inertia[:, linear] = inertia[:, linear] @ turn.T
        return np.asarray(inertia)


def pin_model(robot: Robot, without: Collection[str] = ()) -> PinModel:
    """Build the model of a robot: links that have no parent are free.

    It has room for some hundred joints: Pinocchio's `Data` contains square matrices.

    Args:
        robot: The robot.
        without: Scoped names of links that get no mass.
    """
    builder = _Builder(robot, spanning_tree_of(robot), without)
    # `crba` takes it for granted that the joints of a branch stand together.
    for name in builder.spanning_tree.depth_first:
        builder.add(name)
    return PinModel(builder.model, tuple(builder.degrees), tuple(builder.notes))


def joint_label(joint: str, axis: int) -> str:
    """Return the name of a joint in the model, for one of its axes."""
    return f"{joint} {axis}"


def _free(link: str) -> str:
    return f"{link} (free)"


class _Builder:
    """Adds the links of a robot to a model, parents first.

    Attributes:
        carriers: The joint of the model that carries each link.
        frames: The frame of each joint of the model in the robot's frame.
        poses: The pose of each link in the robot's frame.
    """

    def __init__(self, robot: Robot, spanning_tree: SpanningTree, without: Collection[str]) -> None:
        import pinocchio as pin

        self.robot = robot
        self.without = without
        self.spanning_tree = spanning_tree
        self.model: Any = pin.Model()
        self.degrees: list[Degree] = []
        self.notes = [
            f"Joint {tie.joint.scoped_name} is left out: {tie.child} already has a parent."
            for tie in spanning_tree.left_out
        ]
        self.notes += [
            f"Joint {broken.joint.scoped_name} is left out: {broken.missing.value} is not a link."
            for broken in robot.tree.broken
        ]
        self.carriers = {WORLD: 0}
        self.frames = {0: Transform()}
        self.poses = {WORLD: Transform()}

    def add(self, name: str) -> None:
        """Add a link and the joint to its parent."""
        import pinocchio as pin

        link = self.robot.tree.links[name]
        tie = self.spanning_tree.by.get(name)
        self.poses[name] = self._pose(name, tie)
        carrier = self._free(name) if tie is None else self._hung(name, tie)
        self.carriers[name] = carrier
        frame = self.frames[carrier]
        placement = frame.inverse @ self.poses[name]
        if name not in self.without:
            inertia = self._inertia(link, frame)
            self.model.appendBodyToJoint(carrier, inertia, pin.SE3.Identity())
        self.model.addFrame(pin.Frame(name, carrier, 0, se3(placement), pin.FrameType.BODY), False)

    def _inertia(self, link: Link, frame: Transform) -> pin.Inertia:
        pose = inertial_pose(self.robot, link) or self.poses[link.scoped_name]
        return spatial_inertia(link, frame.inverse @ pose)

    def _pose(self, name: str, tie: Tie | None) -> Transform:
        """Return where a link is; where that is not known, it is where the one above is."""
        pose = self.robot.pose_of(name)
        if pose is not None and all(map(math.isfinite, pose.translation)):
            return pose
        self.notes.append(f"The pose of link {name} is not known.")
        return self.poses[tie.parent] if tie is not None else Transform()

    def _free(self, name: str) -> int:
        import pinocchio as pin

        self.degrees += [Degree(name, number, free=True) for number in range(6)]
        return self._joint(0, pin.JointModelFreeFlyer(), self.poses[name], _free(name))

    def _hung(self, name: str, tie: Tie) -> int:
        """Add the joints of a tie, one for each axis, and return the one that carries the link."""
        carrier = self.carriers[tie.parent]
        motions = motions_of(self.robot, tie.joint)
        if not motions and tie.joint.type.value != "fixed":
            self.notes.append(f"Joint {tie.joint.scoped_name} is treated as fixed.")
        at = self.robot.pose_of_joint(tie.joint) or self.poses[name]
        frame = Transform(self.poses[name].rotation, at.translation)
        for motion in motions:
            kind = _joint_model(motion, frame)
            numbers = range(3) if motion.freedom is Freedom.BALL else (motion.number,)
            self.degrees += [Degree(tie.joint.scoped_name, number) for number in numbers]
            label = joint_label(tie.joint.scoped_name, motion.number)
            carrier = self._joint(carrier, kind, frame, label)
        return carrier

    def _joint(self, parent: int, kind: object, frame: Transform, name: str) -> int:
        placement = se3(self.frames[parent].inverse @ frame)
        # Names come twice in broken models; Pinocchio wants each once.
        while self.model.existJointName(name):
            name += "'"
        joint = int(self.model.addJoint(parent, kind, placement, name))
        self.frames[joint] = frame
        return joint


def _joint_model(motion: Motion, frame: Transform) -> object:
    import numpy as np
    import pinocchio as pin

    if motion.freedom is Freedom.BALL:
        return pin.JointModelSpherical()
    axis = np.array(_turned_back(frame, motion.axis))
    if motion.freedom is Freedom.SLIDE:
        return pin.JointModelPrismaticUnaligned(axis)
    return pin.JointModelRevoluteUnaligned(axis)


def _turned_back(frame: Transform, direction: Vector) -> Vector:
    return Transform(frame.inverse.rotation).rotate(direction)
