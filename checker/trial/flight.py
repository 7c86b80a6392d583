"""Flies a copter: a controller asks for forces, the rotors give what they can."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.trial.allocation import Allocation
from checker.trial.course import CLIMB, CLIMB_METRES
from checker.trial.plan import Plan
from checker.trial.profile import value_at
from checker.trial.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

PILOT_SECONDS = 0.008
"""Between two decisions of the controller: an eightieth of its slowest period."""
_ABOVE = 1.0
"""Metres above the place where it settled."""
_PLACE, _PLACE_DAMPING = 4.0, 4.0
"""1/s², 1/s: 2 rad/s, critically damped."""
_TILT, _TILT_DAMPING = 64.0, 16.0
"""1/s², 1/s: 8 rad/s, critically damped; well above the place's."""
_MOST_LEAN = 0.35
"""Of g, sideways."""


class Pilot:
    """Holds place and heading of a copter, and its height as the course says.

    It knows mass, inertia and centre of mass; the rotors get what their plugins allow.
    """

    def __init__(self, rig: Rig, plan: Plan) -> None:
        import numpy as np

        self.rig, self.plan = rig, plan
        self.gravity = float(np.linalg.norm(rig.model.opt.gravity))
        self.climb = plan.leg(CLIMB)
        self.goal = np.zeros(3)
        self.heading = np.zeros(2)
        self.allocation: Allocation | None = None

    def take_over(self) -> float | None:
        """Lift the copter off the ground, at rest; return the effort of the hover."""
        import mujoco
        import numpy as np

        model, data = self.rig.model, self.rig.data
        data.qvel[:] = 0.0
        for joint in range(model.njnt):
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
                data.qpos[model.jnt_qposadr[joint] + 2] += _ABOVE
        mujoco.mj_forward(model, data)
        self.goal = data.subtree_com[0].copy()
        position, rotation = self.rig.pose()
        self.heading = rotation[:2, 0] / max(np.hypot(*rotation[:2, 0]), 1e-9)
        self.inertia = self._inertia(rotation)
        self.allocation = Allocation.of(
            self.plan.rotors, rotation.T @ (self.goal - position), self.weight
        )
        hover = self.allocation.hover
        return None if hover is None else float(hover.max())

    @property
    def weight(self) -> float:
        """Newtons."""
        return self.rig.mass * self.gravity

    def fly(self, time: float) -> None:
        """Set the forces of the rotors until the next call."""
        import mujoco
        import numpy as np

        if self.allocation is None:
            return
        model, data, rig = self.rig.model, self.rig.data, self.rig
        _, rotation = rig.pose()
        motion = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, rig.root, motion, 0)
        push = self._push(time)
        thrusts = self.allocation.thrusts(
            float(push @ rotation[:, 2]), self._twist(push, rotation, motion[:3])
        )
        forces, torques = self.allocation.given(thrusts)
        data.qfrc_applied[:] = 0.0
        force, torque = rotation @ forces, rotation @ torques
        mujoco.mj_applyFT(
            model, data, force, torque, data.subtree_com[0], rig.root, data.qfrc_applied
        )

    def _push(self, time: float) -> Array:
        """Return the force that place and height ask for, N, in the world's frame."""
        import numpy as np

        data = self.rig.data
        rise = value_at(self.plan.linear, time)
        goal = self.goal + np.array((0.0, 0.0, self._risen(time)))
        velocity = self._velocity()
        wanted = np.array((0.0, 0.0, rise)) - velocity
        pull = _PLACE * (goal - data.subtree_com[0]) + _PLACE_DAMPING * wanted
        sideways = np.hypot(*pull[:2])
        pull[:2] *= min(1.0, _MOST_LEAN * self.gravity / max(sideways, 1e-9))
        pull[2] = np.clip(pull[2] + self.gravity, 0.3 * self.gravity, 3.0 * self.gravity)
        push: Array = self.rig.mass * pull
        return push

    def _velocity(self) -> Array:
        """Return the velocity of the centre of mass, m/s."""
        import mujoco

        mujoco.mj_subtreeVel(self.rig.model, self.rig.data)
        velocity: Array = self.rig.data.subtree_linvel[0]
        return velocity

    def _risen(self, time: float) -> float:
        """Return how far the course wants it above its hover, metres."""
        if self.climb is None:
            return 0.0
        return min(max(time - self.climb.start, 0.0) * self.climb.linear, CLIMB_METRES)

    def _twist(self, push: Array, rotation: Array, spin: Array) -> Array:
        """Return the torque that turns thrust and heading where they should be, robot's frame."""
        import numpy as np

        up = push / max(float(np.linalg.norm(push)), 1e-9)
        lean = np.cross(rotation[:, 2], up)
        heading = rotation[:2, 0]
        yaw = heading[0] * self.heading[1] - heading[1] * self.heading[0]
        wanted = _TILT * lean - _TILT_DAMPING * spin
        wanted[2] = 0.25 * (_TILT * yaw) - 0.5 * _TILT_DAMPING * spin[2]
        twist: Array = self.inertia @ (rotation.T @ wanted)
        return twist

    def _inertia(self, rotation: Array) -> Array:
        """Return the inertia about the centre of mass, robot's axes, kg·m²."""
        import numpy as np

        model, data = self.rig.model, self.rig.data
        total = np.zeros((3, 3))
        for body in range(1, model.nbody):
            axes = data.ximat[body].reshape(3, 3)
            away = data.xipos[body] - data.subtree_com[0]
            own = axes @ np.diag(model.body_inertia[body]) @ axes.T
            total += own + model.body_mass[body] * (away @ away * np.eye(3) - np.outer(away, away))
        turned: Array = rotation.T @ total @ rotation
        return turned
