"""Trials compared with Gazebo's physics: a line for each robot of some folders, and what agrees.

Joints that are moved one by one are not compared: their line has the largest distance from their
paths and the largest share of an effort limit. The last line counts the robots that are moved.

    python -m bench.oracle [--slope DEGREES] [FOLDER...]

The ground is level, or rises along the robot's x axis. Without folders, SUBT_CHECK_CORPUS,
SUBT_CHECK_MODERN and the samples. Debian's
`libignition-physics-dev` and `libsdformat-dev` are needed.
"""

from __future__ import annotations

import math
import os
import statistics
import sys
import tempfile
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path

from checker.base.parts import NotAvailable
from checker.convert.mjcf_files import scene_of_trial
from checker.engine.subject import Subject
from checker.model.locomotion.commanded_joints import moving_controllers
from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.physics.trial.trial import Trial
from support.fortress import LIBRARIES, SOURCE, Refused
from support.fortress.comparison import Comparison, Figures, compared
from support.oracles import compiled, is_installed

ROOT = Path(__file__).parent.parent


def folders(named: list[Path]) -> list[Path]:
    """Return the folders to look at."""
    if named:
        return named
    variables = ("SUBT_CHECK_CORPUS", "SUBT_CHECK_MODERN")
    return [*(Path(os.environ[name]) for name in variables if name in os.environ), ROOT / "samples"]


def robots_in(folder: Path) -> Iterator[tuple[Package, Robot]]:
    """Yield the robots of all packages of a folder."""
    with open_input(folder) as opened:
        for package in opened.packages:
            found = Subject(package).all(Robot)
            if not isinstance(found, NotAvailable):
                yield from ((package, robot) for robot in found)


def line(robot: Robot, result: Comparison | Trial | str) -> str:
    """Return a robot's line: what moved it, and each figure here / there."""
    name = f"{robot.name.value[:32]:32} "
    if isinstance(result, str):
        return name + result
    if isinstance(result, Trial):
        limits = {limit.part: limit.value for limit in result.all("torque_limit")}
        shares = [
            it.value / limits[it.part] for it in result.all("move_torque") if it.part in limits
        ]
        behind = max(error.value for error in result.all("move_error"))
        share = f"  effort {max(shares):.0%}" if shares else ""
        return f"{name}moved joint by joint: {result.moved}  behind {behind:.4f}{share}"
    pairs = [
        f"{label} {getattr(result.here, member):.3f}/{getattr(result.there, member):.3f}"
        for label, member in LABELS.items()
    ]
    return f"{name}{result.plan.kind:20} {'  '.join(pairs)}"


LABELS = {"sink": "sink", "v": "speed", "stop": "stop", "turn": "turn", "full": "full"}


def summary(results: list[Comparison]) -> Iterator[str]:
    """Yield how far the figures are apart: of those in Gazebo, the share."""
    for label, member in LABELS.items():
        apart = [_apart(result.here, result.there, member) for result in results]
        known = sorted(each for each in apart if math.isfinite(each))
        if known:
            least = known[int(0.9 * (len(known) - 1))]
            yield f"{label:5} median {statistics.median(known):.2%}  90 % within {least:.2%}"


def is_moved(robot: Robot) -> bool | None:
    """Return whether the trial moves a robot; None for one without a drive or a controller."""
    scene, plan = scene_of_trial(robot)
    if not scene.unusable and (plan.speeds or plan.belts or plan.rotors or plan.moves):
        return True
    has_drive = robot.locomotion.kind is not DriveKind.NONE
    return False if has_drive or moving_controllers(robot) or robot.driven_joints else None


def _apart(here: Figures, there: Figures, member: str) -> float:
    one, other = getattr(here, member), getattr(there, member)
    return float(abs(one - other) / max(abs(other), 1e-3))


def main() -> None:
    """Compare all robots."""
    parser = ArgumentParser()
    parser.add_argument("--slope", type=float, default=0.0, metavar="DEGREES")
    parser.add_argument("folders", nargs="*", type=Path)
    given = parser.parse_args()
    if not is_installed(LIBRARIES):
        sys.exit("libignition-physics-dev and libsdformat-dev are not installed")
    results: list[Comparison | Trial | str] = []
    counted: list[bool | None] = []
    with tempfile.TemporaryDirectory() as work:
        program = compiled(SOURCE, LIBRARIES, Path(work))
        for folder in folders(given.folders):
            for package, robot in robots_in(folder):
                result: Comparison | Trial | str
                try:
                    result = compared(program, package, robot, math.radians(given.slope))
                except Refused as refusal:
                    result = f"Gazebo refuses it: {refusal}"
                print(line(robot, result), flush=True)
                results.append(result)
                counted.append(is_moved(robot))
    for each in summary([result for result in results if isinstance(result, Comparison)]):
        print(each)
    movable = [each for each in counted if each is not None]
    print(f"{sum(movable)} of {len(movable)} robots with a drive or a controller are moved")


if __name__ == "__main__":
    main()
