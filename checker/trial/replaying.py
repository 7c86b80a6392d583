"""How the links moved in a simulation, for those who look."""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.carriers import TRACKED, carriers_of
from checker.trial.scene import Scene
from checker.trial.simulate import Run
from checker.trial.trial import POSE_NUMBERS, Replay


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
        yield f"more than {TRACKED} links move, so there is no replay of the trial"
