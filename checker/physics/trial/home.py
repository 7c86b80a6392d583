"""What a robot's joints carry in its start pose, and how it comes to rest there, by MuJoCo.

As a module behind `checker.base.child_process` it computes; `at_home` calls it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import convert, field, to_builtins

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.sandbox.files import NO_FILES, Files
from checker.physics.trial.mjcf.scene import GROUND
from checker.physics.trial.run import LIBRARIES, LIMITS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_FAR = 1e6
"""Metres; no shape is so far from the ground."""
_UPRIGHT = 0.95
"""Cosine of the angle by which a robot may lean after it has come to rest."""


class Load(Record):
    """What the motor of a joint moves, in N, kg and m, or in N·m and kg·m².

    Attributes:
        inertia: The force for an acceleration of 1 where all other joints are held.
        felt: The same where these are free, which is less.
        weight: The greatest force of gravity on the parts below, in any pose.
        held: The force that keeps the joint where it starts.
        radius: The distance from the joint to the farthest point of the link that it moves, metres.
    """

    inertia: float
    felt: float
    weight: float
    held: float
    radius: float


class Home(Record):
    """A robot in its start pose.

    Attributes:
        positions: MuJoCo's `qpos`.
        lift: Metres by which a robot that is fixed to the world must rise to be above the ground.
        mass: Kilograms.
        loads: The load of each joint with one axis, by its name.
        forces: Forces of the actuators at rest, N·m or N; 0 before that.
        touching: Pairs of bodies that touch each other, here or where all joints are at 0.
        refused: The reason why MuJoCo refuses the model; else empty.
    """

    positions: tuple[float, ...] = ()
    lift: float = 0.0
    mass: float = 0.0
    loads: Mapping[str, Load] = field(default_factory=dict)
    forces: tuple[float, ...] = ()
    touching: tuple[tuple[str, str], ...] = ()
    refused: str = ""


def at_home(
    mjcf: str,
    starts: Mapping[str, float],
    cache: Cache,
    *,
    seconds: float = 0.0,
) -> Home | WorkerFailed:
    """Return a robot in its start pose, as a child process computes it.

    Args:
        mjcf: The robot on its ground.
        starts: Positions of joints by name, rad or m; 0 for others. Position servos hold them.
        cache: The cache of results.
        seconds: Time in which it may come to rest; its positions are then those afterwards.
    """
    item = {"mjcf": mjcf, "starts": dict(starts), "seconds": seconds}
    key = work_key([json.dumps(item)], ["physics/trial"], LIBRARIES)
    work = Work("home", __name__, LIMITS, {key: item}, partial(convert, type=Home))
    return Background(work, cache).result()


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Return JSON of a `Home` for each of the `items` of a request; see `at_home`."""
    items = json.loads(request)["items"]
    return json.dumps([to_builtins(_home(**item)) for item in items]).encode()


def _home(mjcf: str, starts: Mapping[str, float], seconds: float) -> Home:
    import mujoco

    try:
        model: Any = mujoco.MjModel.from_xml_string(mjcf)
    except ValueError as refusal:
        return Home(refused=" ".join(str(refusal).split()))
    data: Any = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    touching = dict.fromkeys(_touching(model, data))
    for number in range(model.njnt):
        if (start := starts.get(model.joint(number).name)) is not None:
            data.qpos[model.jnt_qposadr[number]] = start
    mujoco.mj_forward(model, data)
    lift = -_lowest(model, data)
    free = model.jnt_type == mujoco.mjtJoint.mjJNT_FREE
    data.qpos[model.jnt_qposadr[free] + 2] += lift
    mujoco.mj_forward(model, data)
    touching |= dict.fromkeys(_touching(model, data))
    loads = dict(_loads(model, data))
    if seconds and free.any():
        _settle(model, data, seconds)
    return Home(
        positions=tuple(data.qpos.tolist()),
        lift=0.0 if free.any() else lift,
        mass=float(model.body_subtreemass[0]),
        loads=loads,
        forces=tuple(data.actuator_force.tolist()),
        touching=tuple(touching),
    )


def _lowest(model: Any, data: Any) -> float:
    """Return the height of the lowest point of all shapes, metres; 0 without any."""
    import mujoco

    ground = model.geom(GROUND).id
    heights = (
        mujoco.mj_geomDistance(model, data, ground, geom, _FAR, None)
        for geom in range(model.ngeom)
        if geom != ground
    )
    return float(min(heights, default=0.0))


def _touching(model: Any, data: Any) -> Iterator[tuple[str, str]]:
    """Yield the names of bodies that touch each other; the world is none."""
    for one, other in data.contact.geom.tolist():
        bodies = sorted(int(model.geom_bodyid[geom]) for geom in (one, other))
        if bodies[0]:
            yield model.body(bodies[0]).name, model.body(bodies[1]).name


def _loads(model: Any, data: Any) -> Iterator[tuple[str, Load]]:
    import mujoco
    import numpy as np

    inverse = np.zeros((model.nv, model.nv))
    if model.nv:
        mujoco.mj_solveM(model, data, inverse, np.eye(model.nv))
    # The diagonal ends each row of the sparse lower triangle.
    diagonal = data.M[model.M_rowadr + model.M_rownnz - 1]
    gravity = float(np.linalg.norm(model.opt.gravity))
    for joint in range(model.njnt):
        kind = model.jnt_type[joint]
        hinge = kind == mujoco.mjtJoint.mjJNT_HINGE
        if not hinge and kind != mujoco.mjtJoint.mjJNT_SLIDE:
            continue
        body, dof = model.jnt_bodyid[joint], model.jnt_dofadr[joint]
        away = data.subtree_com[body] - data.xanchor[joint]
        lever = float(np.linalg.norm(np.cross(away, data.xaxis[joint]))) if hinge else 1.0
        own = model.geom_bodyid == body
        far = np.linalg.norm(data.geom_xpos[own] - data.xanchor[joint], axis=1)
        yield (
            model.joint(joint).name,
            Load(
                inertia=float(diagonal[dof]),
                felt=float(1.0 / inverse[dof, dof]),
                weight=float(model.body_subtreemass[body]) * gravity * lever,
                held=float(data.qfrc_bias[dof]),
                radius=float(np.max(far + model.geom_rbound[own], initial=0.0)),
            ),
        )


def _settle(model: Any, data: Any, seconds: float) -> None:
    """Let a robot come to rest; one that becomes unstable or falls over stays in its pose."""
    import mujoco

    before, base = data.qpos.copy(), int(model.jnt_bodyid[model.jnt_type == 0][0])
    upright = data.xmat[base].copy()
    for number in range(model.nu):
        servo = model.actuator_biasprm[number, 1] != 0
        joint = model.actuator_trnid[number, 0]
        data.ctrl[number] = data.qpos[model.jnt_qposadr[joint]] if servo else 0.0
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    turned = float(data.xmat[base][6:] @ upright[6:])
    if any(warning.number for warning in data.warning) or turned < _UPRIGHT:
        mujoco.mj_resetData(model, data)
        data.qpos[:] = before
