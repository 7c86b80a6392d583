"""A scene in MuJoCo with the servos and belts that a plan needs, found by the robot's names."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any

from checker.physics.trial.mjcf.scene import DROP, GROUND, Scene, carriers_of
from checker.physics.trial.plan import Plan
from checker.physics.trial.simulation.friction import DirectedFriction

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_WHEEL_SECONDS = 0.001
"""Time constant of a wheel's velocity servo."""
_LIMITED_SECONDS = 0.004
"""The same of one whose torque is limited: longer than a step, for its torque is less meanwhile."""
_NEAR_STEPS = 3.0
"""Steps at its limit in which such a servo reaches its command; farther away nothing is kept."""
_ROUNDED = 1.0 + 1e-6
"""A force that just reaches its limit is not cut: MuJoCo does not damp a cut one."""
_FAR = 1e6
"""Metres; no shape is so far from the ground."""
_HOLD_SECONDS = 0.01
"""Time constant of a position servo: stiff for the robot's weight, slow for the time step."""
_WEAK_SECONDS = 0.05
"""The same of one that moves a joint within its effort limit: a stiff one would jump from end to
end of it."""


class Rig:
    """MuJoCo's model and data, ready to step.

    Attributes:
        model, data: MuJoCo's.
        root: Number of the body whose pose is the robot's.
        mass: The mass of the robot, kg.
        parts: The scoped name of the link of each geom; empty for the ground.
        joints: Number of the joint of each actuator.
        names: Scoped name of the joint of each actuator.
        initial: The start positions of these joints, rad or m.
        tracked: Scoped names of the links whose motion is kept.
        bodies: Numbers of their bodies.
        directed: The friction of wheels by direction.
    """

    def __init__(
        self, scene: Scene, plan: Plan, timestep: float, limited: Collection[str] = ()
    ) -> None:
        """Compile the scene.

        Args:
            scene: The robot.
            plan: The commands.
            timestep: Seconds.
            limited: Joints whose servos have no more than the effort limit.

        Raises:
            ValueError: MuJoCo refuses it.
        """
        import mujoco
        import numpy as np

        self.scene, self.plan = scene, plan
        self.model: Any = mujoco.MjModel.from_xml_string(scene.mjcf)
        self.model.opt.timestep = timestep
        self.model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
        self.data: Any = mujoco.MjData(self.model)
        self.root: int = self.model.body(scene.bodies[scene.root]).id
        self.mass = float(self.model.body_subtreemass[0])
        self.parts = [scene.geoms.get(self.model.geom(i).name, "") for i in range(self.model.ngeom)]
        self.names = sorted(scene.actuators, key=self._actuator)
        self.joints = np.array([self._joint(name) for name in self.names], dtype=int)
        self.tracked = list(dict.fromkeys(carriers_of(scene).values()))
        bodies = [self.model.body(scene.bodies[name]).id for name in self.tracked]
        self.bodies = np.array(bodies, dtype=int)
        self._link_place = np.array(scene.root_in_robot[:3])
        turned = np.zeros(9)
        mujoco.mju_quat2Mat(turned, np.array(scene.root_in_robot[3:]))
        self._link_to_robot = turned.reshape(3, 3).T
        mujoco.mj_forward(self.model, self.data)
        self._start()
        self._tune()
        self._limit(limited)
        self.initial = self.positions
        self.belts = self._belts()
        turning = [wheel for wheel in plan.wheels if wheel.joint in scene.joints]
        joints = {wheel.joint: self._joint(wheel.joint) for wheel in turning}
        self.directed = DirectedFriction(self.data, self.parts, turning, joints)

    def step(self) -> None:
        """Advance by one time step."""
        import mujoco

        if not self.directed.needed:
            mujoco.mj_step(self.model, self.data)
            return
        mujoco.mj_step1(self.model, self.data)
        if self.directed.apply():
            mujoco.mj_makeConstraint(self.model, self.data)
            mujoco.mj_projectConstraint(self.model, self.data)
            mujoco.mj_referenceConstraint(self.model, self.data)
        mujoco.mj_step2(self.model, self.data)

    def _actuator(self, joint: str) -> int:
        return int(self.model.actuator(self.scene.actuators[joint]).id)

    def _joint(self, name: str) -> int:
        return int(self.model.joint(self.scene.joints[name]).id)

    @property
    def positions(self) -> Array:
        """Positions of the joints of the actuators, rad or m."""
        positions: Array = self.data.qpos[self.model.jnt_qposadr[self.joints]]
        return positions

    @property
    def forces(self) -> Array:
        """Forces of the servos in the last step, N·m or N.

        MuJoCo states those before the step; a stiff servo that is integrated implicitly gives what
        its law says of the state behind it, which is far less while the command rises.
        """
        import numpy as np

        model, data = self.model, self.data
        speeds = data.qvel[model.jnt_dofadr[self.joints]]
        gain, bias = model.actuator_gainprm[:, 0], model.actuator_biasprm
        forces: Array = gain * data.ctrl + bias[:, 1] * self.positions + bias[:, 2] * speeds
        limits = np.where(model.actuator_forcelimited, model.actuator_forcerange[:, 1], np.inf)
        return np.clip(forces, -limits, limits)

    def pose(self) -> tuple[Array, Array]:
        """Return position (metres) and rotation (3×3) of the robot's frame in the world."""
        return self.frame(self.data.xpos[self.root], self.data.xmat[self.root])

    def frame(self, place: Array, turn: Array) -> tuple[Array, Array]:
        """Return the pose of the robot's frame, from one or many of the body `root`.

        Args:
            place: Position, metres (… × 3).
            turn: Rotation (… × 9).
        """
        rotation = turn.reshape(*turn.shape[:-1], 3, 3) @ self._link_to_robot
        return place - rotation @ self._link_place, rotation

    def _start(self) -> None:
        """Move joints to where they start, and what stands on the ground up or down with them."""
        import mujoco

        starts = [(j, at) for j, at in self.plan.starts.items() if j in self.scene.joints]
        if not starts:
            return
        for name, position in starts:
            self.data.qpos[self.model.jnt_qposadr[self._joint(name)]] = position
        mujoco.mj_forward(self.model, self.data)
        # What has no free joint may have no shapes.
        lift = DROP - self._lowest() if self.scene.free_joints else 0.0
        for joint in self.scene.free_joints.values():
            self.data.qpos[self.model.jnt_qposadr[self.model.joint(joint).id] + 2] += lift
        mujoco.mj_forward(self.model, self.data)

    def _lowest(self) -> float:
        """Return the height of the lowest point of all shapes, metres."""
        import mujoco

        ground = self.model.geom(GROUND).id
        shapes = (geom for geom in range(self.model.ngeom) if geom != ground)
        heights = (
            mujoco.mj_geomDistance(self.model, self.data, ground, geom, _FAR, None)
            for geom in shapes
        )
        return float(min(heights))

    def _tune(self) -> None:
        """Give each servo the stiffness that its load needs."""
        own, reaches = self._own_inertia(), self._reaches()
        wheels = {wheel.joint: wheel for wheel in self.plan.wheels}
        for number, name in enumerate(self.names):
            inertia = own[number]
            if name in wheels:
                share = self.mass / len(wheels)
                inertia += share * wheels[name].radius ** 2
            if name in self.plan.speeds:
                self._velocity_servo(number, inertia / _WHEEL_SECONDS)
            else:
                carried = inertia + self.mass * reaches[number] ** 2
                self._place_by(number, carried, _HOLD_SECONDS)

    def _limit(self, joints: Collection[str]) -> None:
        """Limit the forces of some servos.

        The force of a stiff servo that is cut may turn a wheel past its command in one step. There,
        the servo is softer, and its command is kept near the speed of the wheel (`commanded`).
        """
        import numpy as np

        self._reach = np.full(len(self.names), np.inf)
        self._near = np.zeros(len(self.names))
        self._keeps_near = False
        own = self._own_inertia()
        for number, name in enumerate(self.names):
            if name not in joints:
                continue
            most = self.plan.efforts[name]
            self.model.actuator_forcelimited[number] = 1
            self.model.actuator_forcerange[number] = -_ROUNDED * most, _ROUNDED * most
            if name in self.plan.moves:
                self._place_by(number, own[number], _WEAK_SECONDS)
            if name in self.plan.speeds:
                gain = self.model.actuator_gainprm[number, 0] * _WHEEL_SECONDS / _LIMITED_SECONDS
                self._velocity_servo(number, gain)
                self._keeps_near = True
                self._reach[number] = most / gain
                self._near[number] = _NEAR_STEPS * most * self.model.opt.timestep / own[number]

    def commanded(self, commands: Array) -> Array:
        """Return the commands of the servos, limited where these are near them."""
        import numpy as np

        if not self._keeps_near:
            return commands
        missing = commands - self.data.qvel[self.model.jnt_dofadr[self.joints]]
        limited = commands - missing + np.clip(missing, -self._reach, self._reach)
        near: Array = np.where(np.abs(missing) < self._near, limited, commands)
        return near

    def _own_inertia(self) -> Array:
        """Return each joint's diagonal of the mass matrix, kg·m² or kg."""
        model = self.model
        # The diagonal ends each row of the sparse lower triangle.
        last = model.M_rowadr + model.M_rownnz - 1
        diagonal: Array = self.data.M[last][model.jnt_dofadr[self.joints]]
        return diagonal

    def _reaches(self) -> Array:
        """Return how far from each joint the parts below it reach, metres.

        It is the lever at which a joint carries the robot if the robot stands on these parts.
        """
        import numpy as np

        model, data = self.model, self.data
        reaches = np.zeros(len(self.joints))
        # Bodies are numbered depth first: those below one follow it.
        last = np.arange(model.nbody)
        for body in range(model.nbody - 1, 0, -1):
            parent = model.body_parentid[body]
            last[parent] = max(last[parent], last[body])
        for number, joint in enumerate(self.joints):
            body = model.jnt_bodyid[joint]
            below = (model.geom_bodyid >= body) & (model.geom_bodyid <= last[body])
            away = np.linalg.norm(data.geom_xpos[below] - data.xanchor[joint], axis=1)
            reaches[number] = np.max(away + model.geom_rbound[below], initial=0.0)
        return reaches

    def _velocity_servo(self, number: int, gain: float) -> None:
        """Make a servo hold a speed; it adds what the damping of its joint takes."""
        damping = self.model.dof_damping[self.model.jnt_dofadr[self.joints[number]]]
        self.model.actuator_gainprm[number, 0] = gain
        self.model.actuator_biasprm[number, :3] = 0.0, 0.0, damping - gain

    def _place_by(self, number: int, inertia: float, seconds: float) -> None:
        """Make a servo hold a place, critically damped."""
        stiffness, damping = inertia / seconds**2, 2 * inertia / seconds
        self.model.actuator_gainprm[number, 0] = stiffness
        self.model.actuator_biasprm[number, :3] = 0.0, -stiffness, -damping

    def _belts(self) -> tuple[list[int], list[Array]]:
        """Return the geoms of belts, and in its frame the velocity of each surface at 1 m/s."""
        import numpy as np

        geoms: list[int] = []
        surfaces: list[Array] = []
        _, robot = self.pose()
        for belt in self.plan.belts:
            # The surface runs backwards where it touches the ground.
            surface = -(robot @ np.array(belt.forward))
            for name in self.scene.belts.get(belt.link, ()):
                geom = int(self.model.geom(name).id)
                frame = self.data.geom_xmat[geom].reshape(3, 3)
                geoms.append(geom)
                surfaces.append(frame.T @ surface)
        return geoms, surfaces
