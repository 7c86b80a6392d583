"""Drives a trial in a child process: the module behind `checker.base.child_process`."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from msgspec import convert
from msgspec.structs import replace

from checker.base.sandbox.files import NO_FILES, Files
from checker.physics.trial.course import VERSION
from checker.physics.trial.measures.measurement import measure_motion, measure_torque
from checker.physics.trial.measures.motion import Motion, excess_links, replay_of, series_of
from checker.physics.trial.mjcf.scene import Scene
from checker.physics.trial.plan import Plan
from checker.physics.trial.simulation.contacts import ContactQuery, overlaps
from checker.physics.trial.simulation.paths import with_path
from checker.physics.trial.simulation.simulation import drive
from checker.physics.trial.trial import Measurement, Trial, too_weak


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Drive robots.

    Args:
        request: JSON; `items` with `scene`, `plan` and `timestep` (seconds) each.

    Returns:
        JSON of the trials.
    """
    return json.dumps([_trial(item).as_json() for item in json.loads(request)["items"]]).encode()


def _trial(item: Mapping[str, Any]) -> Trial:
    scene, plan = convert(item["scene"], Scene), convert(item["plan"], Plan)
    return run_trial(scene, plan, item["timestep"])


def run_trial(scene: Scene, plan: Plan, timestep: float) -> Trial:
    """Drive a robot and measure."""
    import mujoco

    trial = Trial(
        drive=plan.kind,
        versions={"mujoco": mujoco.__version__, "course": VERSION},
        repairs=scene.repairs,
        notes=(*scene.notes, *plan.notes, *excess_links(scene)),
        moved=plan.moved,
        not_driven=plan.not_driven,
    )
    try:
        query = ContactQuery(scene)
        plan, on_path = with_path(query, plan)
        motion, needed = driven(scene, plan, timestep)
    except ValueError as refusal:
        return _refused(trial, str(refusal), scene)
    run = motion.run
    return replace(
        trial,
        legs=plan.legs,
        measurements=(*measure_motion(motion, needed), *overlaps(query), *on_path),
        trouble=(run.trouble,) if run.trouble else (),
        series=series_of(motion),
        replay=replay_of(run),
    )


def driven(scene: Scene, plan: Plan, timestep: float) -> tuple[Motion, tuple[Measurement, ...]]:
    """Drive a robot; return its motion and the torques that it needs.

    A run that MuJoCo gives up is tried again with half the step. Where joints need more than their
    effort limit, the robot is driven again within these limits.

    Raises:
        ValueError: MuJoCo refuses the scene.
    """
    run = drive(scene, plan, timestep)
    if run.trouble:
        run = drive(scene, plan, timestep / 2)
    motion = Motion(run, plan)
    needed = tuple(measure_torque(motion))
    weak = too_weak(needed) if plan.limits_act and not run.trouble else ()
    if weak:
        motion = Motion(drive(scene, plan, run.timestep, weak), plan)
    return motion, needed


def _refused(trial: Trial, reason: str, scene: Scene) -> Trial:
    """Name what MuJoCo refuses by the names that the robot gives it."""
    names = {mj: link for link, mj in scene.bodies.items()}
    names |= {mj: joint for joint, mj in scene.joints.items()}
    names |= scene.geoms
    part = next((names[word] for word in _QUOTED.findall(reason) if word in names), "")
    text = _QUOTED.sub(lambda match: f"'{names.get(match[1], match[1])}'", reason)
    return replace(trial, refused=" ".join(text.split()), refused_part=part)


_QUOTED = re.compile(r"'([^']*)'")
