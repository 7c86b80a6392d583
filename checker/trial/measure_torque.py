"""The torque that the course asks of the joints.

It is averaged over 0.1 s: a stiff servo asks for a spike at each bend of its command, which a
motor would round off. Full speed is left out, where only the plugin's limits temper the command.
"""

from __future__ import annotations

from collections.abc import Iterator

from checker.trial.course import CLIMB, DRIVE, HOLD, HOVER, STOP_DRIVE, STOP_TURN, TURN
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_SECONDS = 0.1
_LEGS = (DRIVE, STOP_DRIVE, TURN, STOP_TURN, HOLD, HOVER, CLIMB)


def measure_torque(motion: Motion) -> Iterator[Measurement]:
    """Measure the largest torque (or force) of each joint that has a servo."""
    import numpy as np

    run = motion.run
    legs = [leg for leg in map(motion.leg, _LEGS) if leg is not None]
    if not legs or not run.rig.names:
        return
    count = max(round(_SECONDS / run.timestep), 1)
    first, behind = (round(t / run.timestep) for t in (legs[0].start, legs[-1].end))
    sums = np.cumsum(np.array(run.forces)[first:behind], axis=0)
    means = np.abs(sums[count:] - sums[:-count]) / count
    for number, joint in enumerate(run.rig.names):
        yield Measurement("torque", float(means[:, number].max(initial=0.0)), joint)
        if joint in motion.plan.efforts:
            yield Measurement("torque_limit", motion.plan.efforts[joint], joint)
