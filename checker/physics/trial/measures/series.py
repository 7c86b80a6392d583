"""What happened over time, for plots and replays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from checker.physics.trial.measures.motion import Motion
from checker.physics.trial.mjcf.carriers import TRACKED, carriers_of
from checker.physics.trial.mjcf.scene import Scene
from checker.physics.trial.profile import value_at
from checker.physics.trial.simulation.simulation import Run
from checker.physics.trial.trial import POSE_NUMBERS, Replay

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# How the links moved in a simulation, for those who look.


def replay_of(run: Run) -> Replay | None:
    """Return the motion up to the first number that is not finite; None where nothing is kept."""
    import numpy as np

    rig, samples = run.rig, run.samples
    if not rig.tracked or not samples.tracked:
        return None
    places, turns = (np.array(each) for each in zip(*samples.tracked, strict=True))
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


def too_many(scene: Scene) -> Iterator[str]:
    """Say so where more links move than are kept."""
    if scene.welded and not carriers_of(scene):
        yield f"more than {TRACKED} links move: there is no replay of the trial"


_MOST_PARTS = 40
"""Links, and joints, that get series of their own."""


def series_of(motion: Motion) -> dict[str, Sequence[float]]:
    """Return samples by name, as `Trial.series` lists them."""
    import numpy as np

    rotation, samples, rig = motion.rotation, motion.run.samples, motion.run.rig
    roll = np.arctan2(rotation[:, 2, 1], rotation[:, 2, 2])
    pitch = np.arcsin(np.clip(-rotation[:, 2, 0], -1.0, 1.0))
    found: dict[str, Array] = {
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
    forces = np.array(motion.run.forces)[steps]
    places = np.array(samples.joints)
    for number, joint in enumerate(rig.names[:_MOST_PARTS]):
        found[f"torque:{joint}"] = forces[:, number]
        found[f"joint:{joint}"] = places[:, number]
    found |= _loads(motion)
    return {name: tuple(values.tolist()) for name, values in found.items() if len(values)}


def _loads(motion: Motion) -> dict[str, Array]:
    """Return the mean load of each link around each sample, N, of links that touch the ground."""
    import numpy as np

    touches, count = motion.contacts, len(motion.time)
    nearest = np.abs(touches.time[:, None] - motion.time).argmin(axis=1)
    counts = np.maximum(np.bincount(nearest, minlength=count), 1)
    found: dict[str, Array] = {}
    for number in list(dict.fromkeys(touches.link.tolist()))[:_MOST_PARTS]:
        of = touches.link == number
        total = np.bincount(nearest[touches.sample[of]], touches.loads[of], count)
        found[f"load:{touches.names[number]}"] = total / counts
    return found
