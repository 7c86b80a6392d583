"""Shares the force and the torque that a copter needs among its rotors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from checker.record import record
from checker.trial.plan import PlannedRotor

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@record()
class Allocation:
    """Rotors about a centre of mass.

    Attributes:
        effect: Force (rows 0–2) and torque (3–5) that a newton of each rotor gives, robot's frame.
        most: Greatest thrust of each, N.
        gain: Thrust that comes / thrust asked for.
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
    def of(cls, rotors: Sequence[PlannedRotor], centre: Array, weight: float) -> Allocation:
        """Work out the shares.

        Args:
            rotors: In the robot's frame.
            centre: Of mass, metres.
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
        # Least squares of shares, not of newtons: a weak rotor is asked for less.
        steer = most[:, None] * np.linalg.pinv(lift * most, rcond=1e-9)
        hover = balanced(lift * most, np.array((weight, 0.0, 0.0, 0.0)))
        return cls(effect, most, gain, hover, steer, weight)

    def thrusts(self, lift: float, torque: Array) -> Array:
        """Return the thrusts to ask for, N; the rotors may not be able to give them.

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

    def given(self, thrusts: Array) -> tuple[Array, Array]:
        """Return force (N) and torque (N·m) that come when these thrusts are asked for."""
        import numpy as np

        wrench = self.effect @ np.clip(thrusts * self.gain, 0.0, self.most)
        return wrench[:3], wrench[3:]


def balanced(effect: Array, wanted: Array) -> Array | None:
    """Return the shares s ≥ 0 with effect · s = wanted whose largest is the least; None without.

    A linear program: least squares would ask too much of the weakest arm of a hexacopter.
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
