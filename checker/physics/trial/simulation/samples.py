"""What a simulation does, sample by sample."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.physics.trial.course import SETTLE, TURN
from checker.physics.trial.simulation.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

SAMPLE_SECONDS = 0.05
CLOSE_SECONDS = {SETTLE: 1.0, TURN: 1.5}
"""At the end of which legs, and for how long, contacts are sampled in every step: those of stiff
bodies come and go step by step."""


@dataclass
class Samples:
    """Lists, one entry a sample, in the world's frame if nothing else is said.

    Attributes:
        time: Seconds.
        position: Of the robot's frame, metres.
        rotation: Of the robot's frame, 3×3.
        velocity: Of the origin of the robot's frame, m/s.
        spin: Of the robot, rad/s.
        centre: Of mass, in the robot's frame, metres.
        energy: Potential and kinetic, J.
        joints: Where the joints with a servo stand, rad or m.
        tracked: Positions (metres) and quaternions (w, x, y, z) of the frames of `Rig.tracked`.
    """

    time: list[float] = field(default_factory=list)
    position: list[Array] = field(default_factory=list)
    rotation: list[Array] = field(default_factory=list)
    velocity: list[Array] = field(default_factory=list)
    spin: list[Array] = field(default_factory=list)
    centre: list[Array] = field(default_factory=list)
    energy: list[float] = field(default_factory=list)
    joints: list[Array] = field(default_factory=list)
    tracked: list[tuple[Array, Array]] = field(default_factory=list)


def take(samples: Samples, rig: Rig, time: float) -> None:
    """Add a sample of what MuJoCo worked out in its last step."""
    import mujoco
    import numpy as np

    model, data = rig.model, rig.data
    position, rotation = rig.pose()
    offset = data.xpos[rig.root] - position
    motion = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, rig.root, motion, 0)
    samples.time.append(time)
    samples.position.append(position)
    samples.rotation.append(rotation)
    samples.spin.append(motion[:3])
    samples.velocity.append(motion[3:] - _cross(motion[:3], offset))
    samples.centre.append(rotation.T @ (data.subtree_com[0] - position))
    samples.energy.append(float(data.energy.sum()))
    samples.joints.append(rig.positions)
    samples.tracked.append((data.xpos[rig.bodies], data.xquat[rig.bodies]))


def _cross(one: Array, two: Array) -> Array:
    """Return the cross product of two vectors; NumPy's own is made for many, and slow for two."""
    import numpy as np

    (a, b, c), (x, y, z) = one.tolist(), two.tolist()
    return np.array((b * z - c * y, c * x - a * z, a * y - b * x))
