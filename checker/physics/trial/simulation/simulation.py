"""Drives a robot in MuJoCo: commands in, samples out. Runs in the child process."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.physics.trial.course import HOVER, SETTLE, TURN
from checker.physics.trial.mjcf.scene import Scene
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import Knots
from checker.physics.trial.simulation.contacts import ContactLog
from checker.physics.trial.simulation.flight import PILOT_SECONDS, Pilot
from checker.physics.trial.simulation.moves import PathTorques, moving_commands, path_torques
from checker.physics.trial.simulation.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


# What a simulation does, sample by sample.


SAMPLE_SECONDS = 0.05
CLOSE_SECONDS = {SETTLE: 1.0, TURN: 1.5}
"""Time at the end of these legs in which contacts are sampled in every step: those of stiff
bodies come and go step by step."""


@dataclass
class Samples:
    """Lists, one entry a sample, in the world's frame if nothing else is stated.

    Attributes:
        time: Seconds.
        position: The position of the robot's frame, metres.
        rotation: The rotation of the robot's frame, 3×3.
        velocity: The velocity of the origin of the robot's frame, m/s.
        spin: The angular velocity of the robot, rad/s.
        centre: The centre of mass, in the robot's frame, metres.
        energy: Potential and kinetic, J.
        joints: The positions of the joints with a servo, rad or m.
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
    """Add a sample of what MuJoCo computed in its last step."""
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


_AWAY = 1e4
"""Metres from the start beyond which a robot is not simulated but lost."""
_WARNINGS = {
    "mjWARN_BADQPOS": "a position that is not a usable number",
    "mjWARN_BADQVEL": "a velocity that is not a usable number",
    "mjWARN_BADQACC": "an acceleration that is not a usable number",
}


SETTLED, HOVERING = "settled", "hovering"
"""Names of states: at the end of the leg in which the robot comes to rest, and lifted up."""


@dataclass(frozen=True)
class State:
    """State of all bodies before a step.

    Attributes:
        step: Its number.
        positions: The positions of all degrees of freedom, as MuJoCo's `qpos`.
        velocities: The velocities, as MuJoCo's `qvel`.
    """

    step: int
    positions: Array
    velocities: Array


@dataclass
class Run:
    """A simulation.

    Attributes:
        rig: The rig with the state at the end.
        timestep: Seconds.
        needed: The torques that joints need on their paths.
        samples: The samples at the start and every 50 ms.
        contacts: The contacts with the ground, sampled more often.
        forces: The forces of the servos in each step, N·m or N (steps × servos).
        hover_effort: Largest share of its greatest thrust that a rotor gives to carry the weight;
            None if no shares keep the balance, and for what does not fly.
        trouble: What ended it before its time, as the end of a sentence; else empty.
        commands: The commands of the servos in each step (steps × servos), rad/s, rad or m.
        thrusts: The thrusts of the rotors, N, each with the step in which they begin.
        states: The positions before a step, by the names of states.
        belts: What has surfaces that move; None without.
    """

    rig: Rig
    timestep: float
    needed: PathTorques
    samples: Samples = field(default_factory=Samples)
    contacts: ContactLog = field(default_factory=ContactLog)
    forces: list[Array] = field(default_factory=list)
    hover_effort: float | None = None
    trouble: str = ""
    commands: Array | None = None
    thrusts: list[tuple[int, Array]] = field(default_factory=list)
    states: dict[str, State] = field(default_factory=dict)
    belts: Belts | None = None


def drive(scene: Scene, plan: Plan, timestep: float, limited: Collection[str] = ()) -> Run:
    """Drive the course.

    Args:
        scene: The robot.
        plan: Its commands.
        timestep: Seconds.
        limited: Joints whose servos have no more than the effort limit.

    Raises:
        ValueError: MuJoCo refuses the scene.
    """
    rig = Rig(scene, plan, timestep, limited)
    needed = path_torques(rig)
    run = Run(rig, timestep, needed)
    steps = round(plan.seconds / timestep)
    every, often = round(SAMPLE_SECONDS / timestep), round(PILOT_SECONDS / timestep)
    commands = _commands(rig, needed, steps, timestep)
    belts = run.belts = Belts(rig, plan, steps, timestep) if plan.belts else None
    pilot = Pilot(rig, plan) if plan.rotors else None
    model, data = rig.model, rig.data
    run.commands = commands
    lift, rest = _step_of(plan, HOVER, timestep), _rest_of(plan, timestep)
    touched = _touched(plan, steps, every, timestep)
    for number in range(steps):
        if number == rest:
            run.states[SETTLED] = _state(rig, number)
        data.ctrl[:] = commands[number] = rig.commanded(commands[number])
        if belts is not None and number in belts.changes:
            model.geom_surfacevel[belts.geoms, :3] = belts.velocities(number)
        if pilot is not None and number >= lift:
            if number == lift:
                run.hover_effort = pilot.take_over()
                run.states[HOVERING] = _state(rig, number)
            if (number - lift) % often == 0:
                run.thrusts.append((number, pilot.fly(number * timestep)))
        rig.step()
        run.forces.append(rig.forces)
        if number in touched:
            run.contacts.add(rig, number * timestep)
        if number % every == 0:
            take(run.samples, rig, number * timestep)
            run.trouble = _trouble(rig, number * timestep)
            if run.trouble:
                break
    return run


def _state(rig: Rig, step: int) -> State:
    return State(step, rig.data.qpos.copy(), rig.data.qvel.copy())


def _rest_of(plan: Plan, timestep: float) -> int:
    """Return the step at the end of the leg in which the robot comes to rest."""
    settling = plan.leg(SETTLE)
    return round(settling.end / timestep) if settling is not None else 0


def _step_of(plan: Plan, leg: str, timestep: float) -> int:
    planned = plan.leg(leg)
    return round(planned.start / timestep) if planned is not None else 0


def _touched(plan: Plan, steps: int, every: int, timestep: float) -> set[int]:
    """Return the steps whose contacts are sampled."""
    touched = set(range(0, steps, every))
    for leg in plan.legs:
        close = CLOSE_SECONDS.get(leg.name, 0.0)
        first, behind = round((leg.end - close) / timestep), round(leg.end / timestep)
        touched.update(range(first, behind))
    return touched


def _commands(rig: Rig, needed: PathTorques, steps: int, timestep: float) -> Array:
    """Return the command of each servo in each step (steps × servos)."""
    import numpy as np

    plan = rig.plan
    lines = {**plan.speeds, **plan.places}
    commands = np.zeros((steps, len(rig.names)))
    for column, joint in enumerate(rig.names):
        if joint not in plan.moves:
            commands[:, column] = _sampled(lines[joint], steps, timestep)
    times = np.arange(steps, dtype=np.float64)
    times *= timestep
    return commands + moving_commands(rig, needed, times)


def _sampled(line: Knots, steps: int, timestep: float) -> Array:
    import numpy as np

    times = np.arange(steps) * timestep
    sampled: Array = np.interp(times, [time for time, _ in line], [value for _, value in line])
    return sampled


class Belts:
    """The surfaces of belts.

    Attributes:
        geoms: The geoms whose surfaces move.
        surfaces: The velocity of each at 1 m/s, in its own frame (geoms × 3).
        speeds: The speeds of each in each step, m/s (steps × geoms).
        changes: Steps in which a belt changes its speed.
    """

    def __init__(self, rig: Rig, plan: Plan, steps: int, timestep: float) -> None:
        import numpy as np

        self.geoms, surfaces = rig.belts
        self.surfaces = np.array(surfaces).reshape(-1, 3)
        lines = {belt.link: _sampled(belt.speed, steps, timestep) for belt in plan.belts}
        speeds = [lines[rig.parts[geom]] for geom in self.geoms]
        self.speeds = np.array(speeds).reshape(-1, steps).T
        changed = (np.diff(self.speeds, axis=0) != 0.0).any(axis=1)
        self.changes = {0, *(np.flatnonzero(changed) + 1).tolist()}

    def velocities(self, number: int) -> Array:
        """Return the velocities of the surfaces in a step, m/s, in the frames of their geoms."""
        moved: Array = self.speeds[number][:, None] * self.surfaces
        return moved


def _trouble(rig: Rig, time: float) -> str:
    """Return what went wrong in the simulation, as the end of a sentence; else nothing."""
    import mujoco

    for name, what in _WARNINGS.items():
        warning = rig.data.warning[getattr(mujoco.mjtWarning, name)]
        if warning.number:
            return f"ended after {time:.2f} s with {what} ({name.removeprefix('mjWARN_')})"
    away = math.hypot(*rig.data.xpos[rig.root])
    if not away < _AWAY:
        return f"ended after {time:.2f} s with the robot {away:.3g} m away"
    return ""
