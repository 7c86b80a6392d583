"""A robot's trial compared with the same course in the physics of Gazebo Fortress."""

from __future__ import annotations

import math
import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from msgspec.structs import replace

from checker.convert.mjcf_files import scene_of_trial
from checker.model.robot import Robot
from checker.package.package import Package
from checker.physics.trial.course import DRIVE, FULL, SETTLE, STOP_DRIVE, TURN
from checker.physics.trial.plan import Plan
from checker.physics.trial.run import TIMESTEP
from checker.physics.trial.trial import Trial
from checker.physics.trial.worker import run_trial
from support.fortress import Pose, driven

STEADY = 1.0
"""Seconds at the end of a leg over which a speed is averaged."""
_GRAVITY = 9.8
"""m/s², Gazebo's default."""
_STATED_GRAVITY = re.compile(r'gravity="[^"]*"')


@dataclass(frozen=True)
class Figures:
    """The motion on the course; NaN if the course has no such leg.

    Attributes:
        sink: The way down while settling, metres.
        speed: Forward speed at the end of the straight, m/s.
        stop: Distance of the stop after it, metres.
        turn: Turn rate at the end of the turn, rad/s.
        full: Forward speed at the end of the course, m/s.
    """

    sink: float
    speed: float
    stop: float
    turn: float
    full: float


@dataclass(frozen=True)
class Comparison:
    """The same course twice.

    Attributes:
        trial: The trial in MuJoCo.
        plan: The commands.
        here: The figures of the trial.
        there: The figures in Gazebo's physics.
    """

    trial: Trial
    plan: Plan
    here: Figures
    there: Figures


def compared(
    program: Path, package: Package, robot: Robot, slope: float = 0.0
) -> Comparison | Trial | str:
    """Drive a robot in both; else return why not, as the end of a sentence.

    Of a robot whose joints are moved one by one, the trial in MuJoCo is returned.

    Args:
        program: The compiled program.
        package: The package of the robot; its siblings are found too.
        robot: The robot.
        slope: How steeply the ground rises along the robot's x axis at the start, radians.

    Raises:
        Refused: Gazebo's physics does not load it.
    """
    scene, plan = scene_of_trial(robot)
    if scene.unusable:
        return scene.unusable
    if not plan.speeds and not plan.moved:
        return plan.not_driven or f"its motion is {plan.kind}"
    gravity = (-_GRAVITY * math.sin(slope), 0.0, -_GRAVITY * math.cos(slope))
    sloping = f'gravity="{" ".join(map(repr, gravity))}"'
    scene = replace(scene, mjcf=_STATED_GRAVITY.sub(sloping, scene.mjcf, count=1))
    trial = run_trial(scene, plan, TIMESTEP)
    if trial.refused or plan.moved:
        return trial.refused or trial
    source = robot.span.source
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / f"robot.{robot.format}"
        model.write_text(source.text, "utf-8")
        for each in (package, *package.other_packages):
            (Path(folder) / each.name).symlink_to(each.root)
        folders = [Path(folder), package.root / Path(source.file).parent]
        commands = {"speed": plan.speeds, "place": plan.places}
        drive = driven(
            program, model, scene.spawn_height, plan.seconds, commands, folders, gravity=gravity
        )
    here = zip(*(trial.series[name] for name in ("time", "x", "y", "z", "yaw")), strict=True)
    there = [
        (time, *pose[:3], _yaw(pose)) for time, pose in zip(drive.time, drive.poses, strict=True)
    ]
    return Comparison(trial, plan, _figures(list(here), plan), _figures(there, plan))


Place = tuple[float, float, float, float, float]
"""A time in seconds, x, y, z in metres, and the heading in radians."""


def _figures(places: Sequence[Place], plan: Plan) -> Figures:
    def at(moment: float) -> Place:
        return min(places, key=lambda place: abs(place[0] - moment))

    def ends(name: str, seconds: float = math.inf) -> tuple[Place, Place] | None:
        """Return the first and the last place of the last seconds of a leg."""
        leg = plan.leg(name)
        return (at(max(leg.start, leg.end - seconds)), at(leg.end)) if leg else None

    settled, stop = ends(SETTLE), ends(STOP_DRIVE)
    return Figures(
        sink=places[0][3] - settled[1][3] if settled else math.nan,
        speed=_speeds(ends(DRIVE, STEADY))[0],
        stop=math.dist(stop[0][1:3], stop[1][1:3]) if stop else math.nan,
        turn=_speeds(ends(TURN, STEADY))[1],
        full=_speeds(ends(FULL, STEADY))[0],
    )


def _speeds(ends: tuple[Place, Place] | None) -> tuple[float, float]:
    """Return the mean forward speed (m/s) and turn rate (rad/s) between two places."""
    if ends is None:
        return math.nan, math.nan
    (start, x, y, _, old), (end, u, v, _, new) = ends
    turn = math.remainder(new - old, math.tau)
    heading = old + turn / 2
    along = (u - x) * math.cos(heading) + (v - y) * math.sin(heading)
    return along / (end - start), turn / (end - start)


def _yaw(pose: Pose) -> float:
    _, _, _, w, x, y, z = pose
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
