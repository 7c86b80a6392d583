"""Flies a multicopter: a controller commands forces, the rotors apply it within their limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.physics.trial.course import CLIMB, CLIMB_METRES
from checker.physics.trial.plan import Plan, PlannedRotor
from checker.physics.trial.profile import value_at
from checker.physics.trial.simulation.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# Shares the force and the torque that a copter needs among its rotors.


class Allocation(Record):
    """Rotors about a centre of mass.

    Attributes:
        effect: Force (rows 0–2) and torque (3–5) that a newton of each rotor gives, robot's frame.
        most: Greatest thrust of each, N.
        gain: Actual thrust / commanded thrust.
        hover: Share of its greatest thrust that each gives to carry the weight; None if no shares
            of at least 0 keep the balance.
        steer: Thrusts that a force up and a torque need, as a matrix (n × 4).
    """

    effect: Array
    most: Array
    gain: Array
    hover: Array | None
    steer: Array
    weight: float

    @classmethod
    def from_rotors(
        cls, rotors: Sequence[PlannedRotor], centre: Array, weight: float
    ) -> Allocation:
        """Compute the shares.

        Args:
            rotors: The rotors in the robot's frame.
            centre: The centre of mass, metres.
            weight: N.
        """
        import numpy as np

        up = np.array([rotor.up for rotor in rotors])
        arms = np.array([rotor.centre for rotor in rotors]) - centre
        # The air turns the copter against the rotor's spin.
        drag = np.array([[-rotor.spin * rotor.moment] for rotor in rotors]) * up
        effect = np.vstack([up.T, (np.cross(arms, up) + drag).T])
        most = np.array([rotor.most for rotor in rotors])
        gain = np.array([rotor.gain for rotor in rotors])
        lift = effect[2:]
        # Least squares of shares, not of newtons: a weak rotor gets a smaller command.
        steer = most[:, None] * np.linalg.pinv(lift * most, rcond=1e-9)
        hover = balanced_shares(lift * most, np.array((weight, 0.0, 0.0, 0.0)))
        return cls(effect, most, gain, hover, steer, weight)

    def thrusts(self, lift: float, torque: Array) -> Array:
        """Return the thrusts to command, N; the rotors may not be able to give them.

        Args:
            lift: Force along the robot's z axis, N.
            torque: About the centre of mass, N·m.
        """
        import numpy as np

        if self.hover is None:
            spread: Array = self.steer @ np.array((lift, *torque))
            return spread
        carrying = self.hover * self.most * lift / self.weight
        thrusts: Array = carrying + self.steer @ np.array((0.0, *torque))
        return thrusts

    def delivered_thrusts(self, thrusts: Array) -> Array:
        """Return the actual thrusts for these commands, N."""
        import numpy as np

        clipped: Array = np.clip(thrusts * self.gain, 0.0, self.most)
        return clipped

    def wrench(self, given: Array) -> tuple[Array, Array]:
        """Return the force (N) and the torque (N·m) of thrusts that come."""
        both = self.effect @ given
        return both[:3], both[3:]


def balanced_shares(effect: Array, wanted: Array) -> Array | None:
    """Return the shares s ≥ 0 with effect · s = wanted whose largest is the least; None without.

    A linear program: least squares would overload the weakest arm of a hexacopter.
    """
    import numpy as np
    from scipy.optimize import linprog

    rows, count = effect.shape
    # Each row in its own unit, so that all count alike.
    scale = np.maximum(np.abs(effect).max(axis=1), 1e-12)
    solved = linprog(
        c=[0.0] * count + [1.0],
        A_ub=np.hstack([np.eye(count), -np.ones((count, 1))]),
        b_ub=np.zeros(count),
        A_eq=np.hstack([effect / scale[:, None], np.zeros((rows, 1))]),
        b_eq=wanted / scale,
        bounds=(0.0, None),
    )
    shares: Array | None = solved.x[:count] if solved.success else None
    return shares


PILOT_SECONDS = 0.008
"""Period of the controller: an eightieth of its slowest period."""
_ABOVE = 1.0
"""Metres above the place where it settled."""
_PLACE, _PLACE_DAMPING = 4.0, 4.0
"""1/s², 1/s: 2 rad/s, critically damped."""
_TILT, _TILT_DAMPING = 64.0, 16.0
"""1/s², 1/s: 8 rad/s, critically damped; well above the place's."""
_MOST_LEAN = 0.35
"""Greatest sideways acceleration, as a share of g."""


class Pilot:
    """Holds place and heading of a copter, and its height as the course states.

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
        self.allocation = Allocation.from_rotors(
            self.plan.rotors, rotation.T @ (self.goal - position), self.weight
        )
        hover = self.allocation.hover
        return None if hover is None else float(hover.max())

    @property
    def weight(self) -> float:
        """Newtons."""
        return self.rig.mass * self.gravity

    def fly(self, time: float) -> Array:
        """Set the forces of the rotors until the next call; return their thrusts, N."""
        import mujoco
        import numpy as np

        if self.allocation is None:
            return np.zeros(len(self.plan.rotors))
        model, data, rig = self.rig.model, self.rig.data, self.rig
        _, rotation = rig.pose()
        motion = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, rig.root, motion, 0)
        push = self._push(time)
        thrusts = self.allocation.thrusts(
            float(push @ rotation[:, 2]), self._twist(push, rotation, motion[:3])
        )
        given = self.allocation.delivered_thrusts(thrusts)
        forces, torques = self.allocation.wrench(given)
        data.qfrc_applied[:] = 0.0
        force, torque = rotation @ forces, rotation @ torques
        mujoco.mj_applyFT(
            model, data, force, torque, data.subtree_com[0], rig.root, data.qfrc_applied
        )
        return given

    def _push(self, time: float) -> Array:
        """Return the force that place and height require, N, in the world's frame."""
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
        """Return the height of the course above its hover, metres."""
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
