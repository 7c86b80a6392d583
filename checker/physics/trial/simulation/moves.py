"""Joints that are moved for their own sake: the torque that their motion needs, and commands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.physics.trial.course import MOVE
from checker.physics.trial.profile import smoothed
from checker.physics.trial.simulation.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_LOOK_SECONDS = 0.02
"""Time between the moments whose torques are computed."""


class PathTorques(Record, eq=False):
    """The torques that joints need on their paths while the base of the robot rests.

    Attributes:
        times: Seconds (n).
        torques: N·m or N (n × servos); 0 of joints that are not moved.
    """

    times: Array
    torques: Array


def path_torques(rig: Rig) -> PathTorques:
    """Return the torques of joints on their paths, of a rig that stands at its start."""
    import numpy as np

    legs = rig.plan.legs
    start = next((leg.start for leg in legs if leg.name == MOVE), 0.0)
    times = np.arange(start, legs[-1].end, _LOOK_SECONDS) if legs else np.zeros(1)
    torques = np.zeros((len(times), len(rig.names)))
    moved = [number for number, name in enumerate(rig.names) if name in rig.plan.moves]
    if moved:
        torques[:, moved] = _needed(rig, moved, times)
    return PathTorques(times, torques)


def _needed(rig: Rig, moved: list[int], times: Array) -> Array:
    """Return the torques of inverse dynamics, without contacts and stops (times × joints)."""
    import mujoco
    import numpy as np

    model, option = rig.model, mujoco.mjtDisableBit
    flags, integrator = int(model.opt.disableflags), int(model.opt.integrator)
    joints = rig.joints[moved]
    degrees, addresses = model.jnt_dofadr[joints], model.jnt_qposadr[joints]
    lines = [smoothed(rig.plan.places[rig.names[number]], times) for number in moved]
    paths = np.array(lines).transpose(1, 2, 0)
    data = mujoco.MjData(model)
    data.qpos[:] = rig.data.qpos
    torques = np.zeros((len(times), len(moved)))
    for part in (option.mjDSBL_CONTACT, option.mjDSBL_LIMIT, option.mjDSBL_FRICTIONLOSS):
        model.opt.disableflags |= part
    # The discrete integrator would add what its own servos do in a step.
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    for number, (places, speeds, gains) in enumerate(zip(*paths, strict=True)):
        data.qpos[addresses], data.qvel[degrees], data.qacc[degrees] = places, speeds, gains
        mujoco.mj_inverse(model, data)
        # MuJoCo's own friction gives way below some speed.
        friction = model.dof_frictionloss[degrees] * np.sign(speeds)
        torques[number] = data.qfrc_inverse[degrees] + friction
    model.opt.disableflags, model.opt.integrator = flags, integrator
    return torques


def moving_commands(rig: Rig, needed: PathTorques, times: Array) -> Array:
    """Return the commands of the joints that are moved, rad or m (times × servos); 0 of others.

    They are ahead by what the servo lags behind: by its damping, and by what its load needs.
    """
    import numpy as np

    commands = np.zeros((len(times), len(rig.names)))
    for number, name in enumerate(rig.names):
        if name in rig.plan.moves:
            place, speed, _ = smoothed(rig.plan.places[name], times)
            stiffness, damping = -rig.model.actuator_biasprm[number, 1:3]
            load = np.interp(times, needed.times, needed.torques[:, number])
            commands[:, number] = place + damping / stiffness * speed + load / stiffness
    return commands
