"""A scene in MuJoCo and the robot in Pinocchio, so that their inertias can be compared."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from checker.model.robot import Robot
from checker.physics.mass.pinocchio_model import PinModel, pin_model
from checker.physics.trial.mjcf.scene import Scene, build_scene

Matrix = NDArray[np.float64]

_DEGREES = {
    mujoco.mjtJoint.mjJNT_FREE: 6,
    mujoco.mjtJoint.mjJNT_BALL: 3,
    mujoco.mjtJoint.mjJNT_SLIDE: 1,
    mujoco.mjtJoint.mjJNT_HINGE: 1,
}


@dataclass
class Scales:
    """A robot on both scales, in one pose."""

    robot: Robot

    def __post_init__(self) -> None:
        self.scene: Scene = build_scene(self.robot)
        self.model = mujoco.MjModel.from_xml_string(self.scene.mjcf)
        self.data = mujoco.MjData(self.model)
        self.reference: PinModel = pin_model(self.robot)
        self.q = pin.neutral(self.reference.model)
        self.columns = [self._column(d.part, d.number, d.free) for d in self.reference.degrees]
        self._place()

    def _place(self) -> None:
        """Work out places and inertias alone: a robot that cannot move would be warned of."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_makeM(self.model, self.data)

    def _joint(self, name: str) -> int:
        return int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, name))

    def _column(self, part: str, number: int, free: bool) -> int:
        """Return which velocity of MuJoCo's is a degree of Pinocchio's."""
        if free:
            return int(self.model.jnt_dofadr[self._joint(self.scene.free_joints[part])]) + number
        first = self._joint(self.scene.joints[part])
        ball = self.model.jnt_type[first] == mujoco.mjtJoint.mjJNT_BALL
        return int(self.model.jnt_dofadr[first]) + number if ball else self._single(part, number)

    def _single(self, part: str, number: int) -> int:
        name = self.scene.joints[part]
        return int(self.model.jnt_dofadr[self._joint(f"{name}_2" if number else name)])

    def move(self, seed: int) -> None:
        """Move each hinge and slide to a random place, the same on both scales."""
        random = np.random.default_rng(seed)
        by_column = {column: number for number, column in enumerate(self.columns)}
        for joint in range(self.model.njnt):
            if _DEGREES[mujoco.mjtJoint(self.model.jnt_type[joint])] == 1:
                value = random.uniform(-1.0, 1.0)
                self.data.qpos[self.model.jnt_qposadr[joint]] = value
                velocity = by_column[int(self.model.jnt_dofadr[joint])]
                place = list(self.reference.model.idx_vs).index(velocity)
                self.q[self.reference.model.idx_qs[place]] = value
        self._place()

    def by_pinocchio(self) -> Matrix:
        """Return the joint-space inertia, for velocities as Pinocchio defines them.

        Its columns are the forces of unit accelerations, without gravity. They suppose less than
        `crba`, which is right only where the joints of a model are numbered branch by branch.
        """
        model = self.reference.model.copy()
        model.gravity.setZero()
        data, rest = model.createData(), np.zeros(model.nv)
        return np.column_stack([pin.rnea(model, data, self.q, rest, a) for a in np.eye(model.nv)])

    def by_mujoco(self) -> Matrix:
        """Return the joint-space inertia for the same velocities, in the same order.

        The velocity of a free joint is (v, ω). Both libraries express ω in the body's frame.
        MuJoCo expresses v, the velocity of the body's origin, in the world's frame, Pinocchio in
        the body's: v_mujoco = R · v_pinocchio, with R the body's orientation. With T = diag(R, 1)
        both say the same kinetic energy, so M_pinocchio = Tᵀ · M_mujoco · T.
        """
        full, turn = np.zeros((self.model.nv, self.model.nv)), np.eye(self.model.nv)
        mujoco.mj_fullM(self.model, self.data, full)
        for link, free in self.scene.free_joints.items():
            at = int(self.model.jnt_dofadr[self._joint(free)])
            body = self.data.body(self.scene.bodies[link])
            turn[at : at + 3, at : at + 3] = body.xmat.reshape(3, 3)
        return (turn.T @ full @ turn)[np.ix_(self.columns, self.columns)]

    def balances(self) -> tuple[tuple[float, Matrix], tuple[float, Matrix]]:
        """Return mass and centre of mass of all that moves, by both; in the robot's frame."""
        moving = self.model.body_weldid != 0
        masses = self.model.body_mass[moving]
        centre = masses @ self.data.xipos[moving] / max(masses.sum(), 1e-300)
        centre[2] -= self.scene.spawn_height
        model = self.reference.model
        theirs = pin.centerOfMass(model, model.createData(), self.q)
        return (float(masses.sum()), centre), (float(pin.computeTotalMass(model)), theirs)
