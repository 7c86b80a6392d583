"""All that is measured in a trial."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import chain

from checker.physics.trial.course import (
    CLIMB,
    CLIMB_METRES,
    DRIVE,
    HOLD,
    HOVER,
    MOVE,
    SETTLE,
    STOP_DRIVE,
    STOP_TURN,
    TOGETHER,
    TURN,
)
from checker.physics.trial.measures.drive import measure_drive, measure_turn
from checker.physics.trial.measures.ground import drag, loads
from checker.physics.trial.measures.motion import Motion, averaged
from checker.physics.trial.profile import smoothed
from checker.physics.trial.trial import MOVE_TORQUE, TORQUE, TORQUE_LIMIT, Leg, Measurement

# Hovering and climbing.


_END = 1.0
"""Seconds at the end of a leg."""


def measure_flight(motion: Motion) -> Iterator[Measurement]:
    """Measure what the rotors give, and how the copter hovers and climbs."""
    rotors = motion.plan.rotors
    if rotors and motion.weight > 0.0:
        lift = sum(rotor.most * max(rotor.up[2], 0.0) for rotor in rotors)
        yield Measurement("thrust_to_weight", lift / motion.weight)
    yield from _hover(motion)
    climb, hover = motion.leg(CLIMB), motion.leg(HOVER)
    if climb is not None and hover is not None:
        heights = motion.position[:, 2]
        top, before = heights[motion.last(climb, 0.1)], heights[motion.last(hover, 0.1)]
        yield Measurement("climbed", float((top.mean() - before.mean()) / CLIMB_METRES))


def _hover(motion: Motion) -> Iterator[Measurement]:
    leg = motion.leg(HOVER)
    if leg is None:
        return
    effort = motion.run.hover_effort
    if effort is not None:
        yield Measurement("hover_effort", effort)
    heights = motion.position[motion.samples_during(leg)][:, 2]
    end = motion.last(leg, _END)
    yield Measurement("hover_sink", float(heights[0] - heights[-20:].mean()))
    yield Measurement("hover_tilt", float(motion.tilt[end].max()))


# The torque that the course asks of the joints. Full speed is left out, where only the plugin's
# limits temper the command.


_LEGS = (DRIVE, STOP_DRIVE, TURN, STOP_TURN, HOLD, HOVER, CLIMB)


def measure_torque(motion: Motion) -> Iterator[Measurement]:
    """Measure the largest torque (or force) of each joint that has a servo."""
    import numpy as np

    run = motion.run
    legs = [leg for leg in map(motion.leg, _LEGS) if leg is not None]
    if not legs or not run.rig.names:
        return
    first, behind = (round(t / run.timestep) for t in (legs[0].start, legs[-1].end))
    means = np.abs(averaged(np.array(run.forces)[first:behind], run.timestep))
    on_path = np.abs(run.needed.torques)
    for number, joint in enumerate(run.rig.names):
        yield Measurement(TORQUE, float(means[:, number].max(initial=0.0)), joint)
        if joint in motion.plan.efforts:
            yield Measurement(TORQUE_LIMIT, motion.plan.efforts[joint], joint)
        if joint in motion.plan.moves:
            yield Measurement(MOVE_TORQUE, float(on_path[:, number].max(initial=0.0)), joint)


# Joints that are moved one by one and together: how far they are from where they should be.


_MOVING = (MOVE, TOGETHER)


def measure_moves(motion: Motion) -> Iterator[Measurement]:
    """Measure how far each joint moves alone, and its largest distance from its path."""
    import numpy as np

    legs = [leg for leg in map(motion.leg, _MOVING) if leg is not None]
    if not legs:
        return
    during = motion.samples_between(legs[0].start, legs[-1].end)
    places = np.array(motion.run.samples.joints)[during]
    for number, joint in enumerate(motion.run.rig.names):
        move = motion.plan.moves.get(joint)
        if move is not None:
            expected, *_ = smoothed(motion.plan.places[joint], motion.time[during])
            yield Measurement("move_step", abs(move.step), joint)
            error = float(np.abs(places[:, number] - expected).max(initial=0.0))
            yield Measurement("move_error", error, joint)


# Energy: what is not driven must not gain any.


_HEIGHT = 0.1
"""Metres: the unit is the energy that lifts the robot by this."""
_AFTER_STOP = 0.5
"""Seconds at the end of a stop, when the wheels stand."""


def measure_energy(motion: Motion) -> Iterator[Measurement]:
    """Measure the largest gain while a robot is not driven."""
    import numpy as np

    energy = np.array(motion.run.samples.energy)
    stretches = []
    for name in (SETTLE, STOP_DRIVE, STOP_TURN):
        leg = motion.leg(name)
        if leg is not None:
            stretches.append(_undriven(motion, leg))
    gains = [
        float((energy[stretch] - np.minimum.accumulate(energy[stretch])).max())
        for stretch in stretches
    ]
    if gains and motion.weight > 0.0:
        yield Measurement("energy_gain", max(gains) / (motion.weight * _HEIGHT))


def _undriven(motion: Motion, leg: Leg) -> slice:
    return motion.samples_during(leg) if leg.name == SETTLE else motion.last(leg, _AFTER_STOP)


# What the drive wheels carry at rest.


_AT_REST = {SETTLE: 1.0, STOP_DRIVE: _AFTER_STOP, STOP_TURN: _AFTER_STOP}
"""Seconds over which loads are averaged, at the end of each leg: one instant misleads."""


def measure_loads(motion: Motion) -> Iterator[Measurement]:
    """Measure each drive wheel's load against an equal share of the weight, and what drags.

    Strongly damped springs move slowly: on springs, the largest load of all stops counts.
    """
    wheels = motion.plan.wheels
    on_springs = bool(motion.run.rig.model.jnt_stiffness.any())
    rests = [leg for name in _AT_REST if (leg := motion.leg(name)) is not None]
    if not rests or rests[0].name != SETTLE or not motion.weight > 0.0:
        return
    stops = rests if on_springs else rests[:1]
    touches = [motion.touches(leg, _AT_REST[leg.name]) for leg in stops]
    carried = [loads(each) for each in touches]
    for wheel in wheels:
        load = max(sum(each.get(link, 0.0) for link in wheel.links) for each in carried)
        yield Measurement("load_share", load * len(wheels) / motion.weight, wheel.joint)
    for link, force in drag(motion, touches[0]).items() if wheels else ():
        yield Measurement("drag", force / motion.weight, link)


# Standing: how a robot that does not drive keeps the pose it starts in.


_HELD = 0.5
"""Seconds at the end of the leg."""


def measure_hold(motion: Motion) -> Iterator[Measurement]:
    """Measure how far joints, height and attitude leave the pose."""
    import numpy as np

    leg = motion.leg(HOLD)
    if leg is None:
        return
    during, end = motion.samples_during(leg), motion.last(leg, _HELD)
    sags = np.abs(np.array(motion.run.samples.joints)[end] - motion.run.rig.initial).max(axis=0)
    if sags.size:
        # Of joints that give way alike the first is named, mostly whatever the last digits say.
        worst = int(sags.round(4).argmax())
        yield Measurement("hold_sag", float(sags.max()), motion.run.rig.names[worst])
    heights = motion.position[during][:, 2]
    yield Measurement("hold_sink", float(heights[0] - heights.min()))
    yield Measurement("hold_tilt", float(motion.tilt[end].max()))


# Settling: two seconds without command, from 10 mm above the ground.


_SETTLED = 0.5
"""Seconds over which what rests is looked at."""


def measure_settle(motion: Motion) -> Iterator[Measurement]:
    """Measure how a robot comes to rest."""
    import numpy as np

    leg = motion.leg(SETTLE)
    if leg is None:
        return
    during, rest = motion.samples_during(leg), motion.last(leg, _SETTLED)
    place = motion.position[during]
    heights = place[:, 2] - place[0, 2]
    yield Measurement("settle_drop", float(-heights.min()))
    yield Measurement("settle_rise", float(heights.max()))
    yield Measurement("settle_shift", float(np.hypot(*(place[-1] - place[0])[:2])))
    yield Measurement("settle_tilt", float(motion.tilt[rest].mean()))
    speeds = np.linalg.norm(motion.velocity[rest], axis=1)
    yield Measurement("settle_speed", float(speeds.mean()))
    deepest = motion.touches(leg, _SETTLED).depth.max(initial=0.0)
    yield Measurement("rest_penetration", float(deepest))


def measure_motion(motion: Motion, torques: Sequence[Measurement]) -> Iterator[Measurement]:
    """Yield the figures of a run; those that are no finite numbers are none.

    Args:
        motion: The run.
        torques: What `measure_torque` measured, of a run without limits.
    """
    parts = (
        measure_settle(motion),
        measure_drive(motion),
        measure_turn(motion),
        measure_loads(motion),
        torques,
        measure_flight(motion),
        measure_hold(motion),
        measure_moves(motion),
        measure_energy(motion),
    )
    return (figure for figure in chain.from_iterable(parts) if math.isfinite(figure.value))
