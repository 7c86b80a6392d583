"""What a simulation does, sample by sample."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.trial.course import SETTLE, TURN
from checker.trial.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

SAMPLE_SECONDS = 0.05
CLOSE_SECONDS = {SETTLE: 1.0, TURN: 1.5}
"""At the end of which legs, and for how long, contacts are sampled in every step: those of stiff
bodies come and go step by step."""


@dataclass(frozen=True)
class Touch:
    """The contacts with the ground at one time, and how the wheels stood.

    Attributes:
        time: Seconds.
        links: Scoped names of the links that touch, one a contact.
        geoms: Numbers of their geoms.
        points: Where, in the robot's frame, metres (n × 3).
        loads: Normal forces, N (n).
        friction: Coefficients (n).
        depth: Deepest penetration, metres.
        anchors: Where the joints with a servo are, in the robot's frame, metres.
        axes: Their axes, in the robot's frame.
    """

    time: float
    links: list[str]
    geoms: Array
    points: Array
    loads: Array
    friction: Array
    depth: float
    anchors: Array
    axes: Array


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
        touches: Contacts with the ground, sampled more often than the rest.
    """

    time: list[float] = field(default_factory=list)
    position: list[Array] = field(default_factory=list)
    rotation: list[Array] = field(default_factory=list)
    velocity: list[Array] = field(default_factory=list)
    spin: list[Array] = field(default_factory=list)
    centre: list[Array] = field(default_factory=list)
    energy: list[float] = field(default_factory=list)
    joints: list[Array] = field(default_factory=list)
    touches: list[Touch] = field(default_factory=list)


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
    samples.velocity.append(motion[3:] - np.cross(motion[:3], offset))
    samples.centre.append(rotation.T @ (data.subtree_com[0] - position))
    samples.energy.append(float(data.energy.sum()))
    samples.joints.append(rig.positions)


def touch(rig: Rig, time: float) -> Touch:
    """Return the contacts of MuJoCo's last step."""
    import numpy as np

    data = rig.data
    position, rotation = rig.pose()
    contact = data.contact
    # A contact that the solver left out has no force.
    used = contact.efc_address >= 0
    geoms = contact.geom[used].max(axis=1) if used.any() else np.zeros(0, dtype=int)
    return Touch(
        time=time,
        links=[rig.parts[geom] for geom in geoms],
        geoms=geoms,
        points=(contact.pos[used] - position) @ rotation,
        loads=data.efc_force[contact.efc_address[used]],
        friction=contact.friction[used, 0],
        depth=float(-contact.dist[used].min(initial=0.0)),
        anchors=(data.xanchor[rig.joints] - position) @ rotation,
        axes=data.xaxis[rig.joints] @ rotation,
    )
