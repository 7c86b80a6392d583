"""The samples of a run as arrays, cut into legs; and how links moved, for plots and replays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.physics.trial.mjcf.scene import TRACKED, Scene, carriers_of
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import value_at
from checker.physics.trial.simulation.contacts import Touches
from checker.physics.trial.simulation.simulation import Run
from checker.physics.trial.trial import POSE_NUMBERS, Leg, Replay

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


_SLACK = 1e-6
"""Seconds, for times that are sums of steps."""


@dataclass
class Motion:
    """A run, as measurements need it.

    Attributes:
        time: Seconds (n).
        position: The position of the robot's frame, metres (n × 3).
        rotation: The rotation of the robot's frame in the world (n × 3 × 3).
        velocity: The velocity of the origin of the robot's frame in the world, m/s (n × 3).
        spin: The angular velocity in the world, rad/s (n × 3).
        yaw: Heading without jumps, radians (n).
        tilt: The angle between the robot's z axis and the vertical, radians (n).
        forward: Speed along the robot's x axis, m/s (n).
        contacts: The contacts with the ground, sampled more often than the rest.
    """

    run: Run
    plan: Plan
    time: Array = field(init=False)
    position: Array = field(init=False)
    rotation: Array = field(init=False)
    velocity: Array = field(init=False)
    spin: Array = field(init=False)
    yaw: Array = field(init=False)
    tilt: Array = field(init=False)
    forward: Array = field(init=False)
    contacts: Touches = field(init=False)

    def __post_init__(self) -> None:
        import numpy as np

        samples = self.run.samples
        self.time = np.array(samples.time)
        self.position = np.array(samples.position)
        self.rotation = np.array(samples.rotation)
        self.velocity = np.array(samples.velocity)
        self.spin = np.array(samples.spin)
        self.yaw = np.unwrap(np.arctan2(self.rotation[:, 1, 0], self.rotation[:, 0, 0]))
        self.tilt = np.arccos(np.clip(self.rotation[:, 2, 2], -1.0, 1.0))
        self.forward = np.einsum("ij,ij->i", self.velocity, self.rotation[:, :, 0])
        self.contacts = self.run.contacts.touches(self.run.rig)

    def samples_between(self, start: float, end: float) -> slice:
        """Return the samples of a stretch of time, seconds, its end excluded."""
        import numpy as np

        first, behind = np.searchsorted(self.time, (start - _SLACK, end - _SLACK))
        return slice(int(first), int(behind))

    def samples_during(self, leg: Leg) -> slice:
        """Return the samples of a leg."""
        return self.samples_between(leg.start, leg.end)

    def last(self, leg: Leg, seconds: float) -> slice:
        """Return the samples of the end of a leg."""
        return self.samples_between(max(leg.end - seconds, leg.start), leg.end)

    def leg(self, name: str) -> Leg | None:
        """Return a leg that was driven to its end; None without."""
        leg = self.plan.leg(name)
        finished = leg is not None and len(self.time) > 0 and self.time[-1] > leg.end - 0.1
        return leg if finished else None

    def touches(self, leg: Leg, seconds: float) -> Touches:
        """Return the contacts at the end of a leg."""
        return self.contacts.between(max(leg.end - seconds, leg.start) - _SLACK, leg.end - _SLACK)

    @property
    def weight(self) -> float:
        """Newtons."""
        import numpy as np

        return self.run.rig.mass * float(np.linalg.norm(self.run.rig.model.opt.gravity))


AVERAGED_SECONDS = 0.1
"""Time over which a joint's torque is averaged, in figures and plots: a stiff servo commands a
spike at each bend of its command, which a motor would round off."""


def averaged(forces: Array, timestep: float) -> Array:
    """Return the mean of each stretch of `AVERAGED_SECONDS`; the first ends with its last step.

    Args:
        forces: One row a step.
        timestep: Seconds.
    """
    import numpy as np

    count = max(round(AVERAGED_SECONDS / timestep), 1)
    sums = np.cumsum(forces, axis=0)
    means: Array = (sums[count:] - sums[:-count]) / count
    return means


# What happened over time, for plots and replays.


# Motion of the links in a simulation, for display.


def replay_of(run: Run) -> Replay | None:
    """Return the motion up to the first number that is not finite; None if nothing is kept."""
    import numpy as np

    rig, samples = run.rig, run.samples
    if not rig.tracked or not samples.tracked:
        return None
    places, turns = (np.array(column) for column in zip(*samples.tracked, strict=True))
    with np.errstate(over="ignore"):
        poses = np.concatenate((places, turns), axis=2).astype(np.float32)
    broken = np.flatnonzero(~np.isfinite(poses).all(axis=(1, 2)))
    end = int(broken[0]) if len(broken) else len(poses)
    if not end:
        return None
    flat = poses[:end].transpose(1, 0, 2).reshape(-1, end * POSE_NUMBERS)
    moving = dict(zip(rig.tracked, map(tuple, flat.tolist()), strict=True))
    carriers = {name: by for name, by in carriers_of(rig.scene).items() if name not in moving}
    return Replay(tuple(samples.time[:end]), moving, carriers)


def excess_links(scene: Scene) -> Iterator[str]:
    """Yield so where more links move than are kept."""
    if scene.welded and not carriers_of(scene):
        yield f"more than {TRACKED} links move, so there is no replay of the trial"


_MOST_PARTS = 40
"""Links, and joints, that get their own series."""


def series_of(motion: Motion) -> dict[str, Sequence[float]]:
    """Return samples by name, as `Trial.series` lists them."""
    import numpy as np

    rotation, samples, rig = motion.rotation, motion.run.samples, motion.run.rig
    roll = np.arctan2(rotation[:, 2, 1], rotation[:, 2, 2])
    pitch = np.arcsin(np.clip(-rotation[:, 2, 0], -1.0, 1.0))
    curves: dict[str, Array] = {
        "time": motion.time,
        **dict(zip("xyz", motion.position.T, strict=True)),
        "roll": roll,
        "pitch": pitch,
        "yaw": motion.yaw,
        "speed": motion.forward,
        "yaw_rate": motion.spin[:, 2],
        "command_linear": np.array([value_at(motion.plan.linear, t) for t in motion.time]),
        "command_angular": np.array([value_at(motion.plan.angular, t) for t in motion.time]),
    }
    steps = np.rint(motion.time / motion.run.timestep).astype(int)
    forces = _averaged_at(steps, motion.run)
    places = np.array(samples.joints)
    for number, joint in enumerate(rig.names[:_MOST_PARTS]):
        curves[f"torque:{joint}"] = forces[:, number]
        curves[f"joint:{joint}"] = places[:, number]
    curves |= _loads(motion)
    return {name: tuple(values.tolist()) for name, values in curves.items() if len(values)}


def _averaged_at(steps: NDArray[np.int64], run: Run) -> Array:
    """Return the averaged forces of the stretches that end at some steps; before that, zero."""
    import numpy as np

    forces = np.array(run.forces)
    means = averaged(forces, run.timestep)
    padded = np.concatenate((np.zeros((len(forces) - len(means), forces.shape[1])), means))
    at: Array = padded[steps]
    return at


def _loads(motion: Motion) -> dict[str, Array]:
    """Return the mean load of each link around each sample, N, of links that touch the ground."""
    import numpy as np

    touches, count = motion.contacts, len(motion.time)
    nearest = np.abs(touches.time[:, None] - motion.time).argmin(axis=1)
    counts = np.maximum(np.bincount(nearest, minlength=count), 1)
    curves: dict[str, Array] = {}
    for number in list(dict.fromkeys(touches.link.tolist()))[:_MOST_PARTS]:
        of = touches.link == number
        total = np.bincount(nearest[touches.sample[of]], touches.loads[of], count)
        curves[f"load:{touches.names[number]}"] = total / counts
    return curves
