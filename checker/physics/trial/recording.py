"""The trial as numbers that MuJoCo needs to repeat it: gains, states and commands.

As a module behind `checker.base.child_process` it drives the robot; `recorded` calls it.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import convert, field, to_builtins

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.sandbox.files import NO_FILES, Files
from checker.physics.trial.mjcf.scene import Scene
from checker.physics.trial.plan import Plan
from checker.physics.trial.run import LIBRARIES, LIMITS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    from checker.physics.trial.simulation.simulation import Run


Changes = tuple[tuple[int, tuple[float, ...]], ...]
"""Values with the step in which they begin; they last to the next."""


class Servo(Record):
    """A servo as it was tuned.

    Attributes:
        joint: Scoped name.
        stiffness: N·m/rad or N/m; 0 for a servo that holds a velocity.
        damping: N·m·s/rad or N·s/m; of one that holds a velocity, its gain.
        limit: N·m or N at most; 0 for one without limit.
    """

    joint: str
    stiffness: float
    damping: float
    limit: float = 0.0


class BeltSurface(Record):
    """A geom of the scene that moves as the surface of a belt: its direction, in its own frame."""

    geom: str
    direction: tuple[float, ...]


class RecordedState(Record):
    """State of all bodies before a step, as MuJoCo's `qpos` and `qvel`."""

    step: int
    positions: tuple[float, ...]
    velocities: tuple[float, ...]


class Recording(Record):
    """Recording of a trial.

    Attributes:
        timestep: Seconds.
        servos: The servos in the order of the scene's actuators.
        states: The states by name: `settled`, and `hovering` for robots that fly.
        commands: The commands of each servo, in the steps in which one of them changes; each lasts
            to the next.
        thrusts: The thrusts of each rotor likewise, N.
        belts: The geoms that move as the surface of a belt.
        speeds: The speeds of each of them likewise, m/s.
        refused: The reason why MuJoCo refuses the scene; else empty.
    """

    timestep: float = 0.0
    servos: tuple[Servo, ...] = ()
    states: Mapping[str, RecordedState] = field(default_factory=dict)
    commands: Changes = ()
    thrusts: Changes = ()
    belts: tuple[BeltSurface, ...] = ()
    speeds: Changes = ()
    refused: str = ""


def recorded(scene: Scene, plan: Plan, timestep: float, cache: Cache) -> Recording | WorkerFailed:
    """Drive a robot in a child process, and return what MuJoCo needs to repeat it."""
    item = {"scene": to_builtins(scene), "plan": to_builtins(plan), "timestep": timestep}
    key = work_key([json.dumps(item)], ["physics/trial"], LIBRARIES)
    work = Work("recording", __name__, LIMITS, {key: item}, partial(convert, type=Recording))
    return Background(work, cache).result()


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Drive robots.

    Args:
        request: JSON; `items` with `scene`, `plan` and `timestep` (seconds) each.

    Returns:
        JSON of the recordings.
    """
    items = json.loads(request)["items"]
    return json.dumps([to_builtins(_recording(item)) for item in items]).encode()


def _recording(item: Mapping[str, Any]) -> Recording:
    from checker.physics.trial.simulation.contacts import ContactQuery
    from checker.physics.trial.simulation.paths import with_path
    from checker.physics.trial.worker import driven

    scene, plan = convert(item["scene"], Scene), convert(item["plan"], Plan)
    timestep = item["timestep"]
    try:
        path = with_path(ContactQuery(scene), plan)[0] if plan.moves else plan
        motion, _ = driven(scene, path, timestep)
    except ValueError as refusal:
        return Recording(timestep, refused=" ".join(str(refusal).split()))
    return _recording_of(motion.run)


def _servo(model: Any, number: int, name: str) -> Servo:
    gain, (_, place, speed) = model.actuator_gainprm[number, 0], model.actuator_biasprm[number, :3]
    # What a velocity servo adds for its joint's damping is no gain.
    damping = -speed if place else gain
    return Servo(name, -float(place), float(damping), float(model.actuator_forcerange[number, 1]))


def _recording_of(run: Run) -> Recording:
    model = run.rig.model
    servos = (_servo(model, number, name) for number, name in enumerate(run.rig.names))
    states = {
        name: RecordedState(
            state.step, tuple(state.positions.tolist()), tuple(state.velocities.tolist())
        )
        for name, state in run.states.items()
    }
    thrusts = tuple((step, tuple(given.tolist())) for step, given in run.thrusts)
    belts: tuple[BeltSurface, ...] = ()
    if run.belts is not None:
        named = zip(run.belts.geoms, run.belts.surfaces.tolist(), strict=True)
        belts = tuple(BeltSurface(model.geom(geom).name, tuple(way)) for geom, way in named)
    return Recording(
        run.timestep,
        tuple(servos),
        states,
        _changes(run.commands),
        thrusts,
        belts,
        _changes(run.belts.speeds if run.belts is not None else None),
    )


def _changes(rows: Array | None) -> Changes:
    """Return the rows (one a step) that differ from the one before."""
    import numpy as np

    if rows is None or not len(rows):
        return ()
    differing = (np.diff(rows, axis=0) != 0.0).any(axis=1)
    steps = [0, *(np.flatnonzero(differing) + 1).tolist()]
    return tuple((step, tuple(rows[step].tolist())) for step in steps)
