"""Planted physical faults: does `--fix --unsafe --prove` repair each, and spoil nothing?

Run with `python -m bench.repairs [--seed N] [--only WORDS]` from the top folder. Faults are planted
one by one in real submissions (SUBT_CHECK_CORPUS), in a URDF of SUBT_CHECK_MODERN and in those of
PyPI's example-robot-data. A fault is repaired if a rule finds it, this rule reports nothing of it
afterwards, and the package, trial included, has no more errors than before it was planted; it is
worse if it has more errors than with the fault.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from random import Random

from bench.faults import Robot, copy_package, submission
from bench.planted.physics import OF_SDF, OF_URDF
from checker.base.record import Record
from checker.cli.check.fix import fix_paths
from checker.finding import Safety, Severity
from checker.pipeline import check_package
from checker.settings import Settings

GOAL = 0.9
"""Share of the faults."""
MODERN = "bugs/nav2-imu-joint/after/nav2_minimal_tb3_sim"
EXAMPLES = (
    ("a1_description", "a1"),
    ("panda_description", "panda"),
    ("laikago_description", "laikago"),
    ("simple_humanoid_description", "simple_humanoid"),
)
ROBOTS = (
    submission("coro_jeanine_sensor_config_1", OF_SDF),
    submission("coro_rocky_sensor_config_1", OF_SDF),
    submission("explorer_ds1_sensor_config_1", OF_SDF),
    Robot(
        "turtlebot3_waffle.urdf",
        "modern",
        MODERN,
        "urdf/turtlebot3_waffle.urdf",
        "nav2_minimal_tb3_sim",
        "urdf",
        OF_URDF,
    ),
    *(
        Robot(
            f"{robot}.urdf",
            "urdf",
            folder,
            f"urdf/{robot}.urdf",
            f"example-robot-data/robots/{folder}",
            "urdf",
            OF_URDF,
        )
        for folder, robot in EXAMPLES
    ),
)


class Result(Record):
    """Result of a planted fault.

    Attributes:
        found: Whether a rule that must find it does.
        left: Rules that report it, or more errors than of the intact robot, once it is fixed.
        worse: Rules that report more errors than of the robot with the fault.
    """

    robot: str
    kind: str
    found: bool
    left: tuple[str, ...]
    worse: tuple[str, ...]


def counted(path: Path, robot: Robot) -> Counter[tuple[str, Severity]]:
    """Count the places of errors and warnings by rule, the trial included."""
    settings = Settings(profile=robot.profile, profile_chosen=True)
    return Counter(
        (finding.rule, finding.severity)
        for package in check_package(path, settings).packages
        for finding in package.findings
        if finding.severity is not Severity.INFO
        for place in finding.places
        if not place.note
    )


def repaired(number: int, place: int, seed: int) -> Result | None:
    """Plant a fault and fix the package; None if the robot has nothing that could have it.

    Args:
        number: The number of the robot.
        place: The place of the kind among those of the robot.
        seed: The seed of the random choice of the place.
    """
    robot, kind = ROBOTS[number], ROBOTS[number].kinds[place]
    with tempfile.TemporaryDirectory() as folder:
        package = copy_package(robot, folder)
        path = package / robot.checked
        intact = counted(path, robot)
        if not kind.edit(package, Random(f"{seed} {robot.name} {kind.name}")):
            return None
        planted = counted(path, robot)
        wishes = {"profile": robot.profile}
        fix_paths([path], wishes, list(Safety), write=True, dirty=True, prove=True)
        fixed = counted(path, robot)
        more, worse = fixed - intact, fixed - planted
        return Result(
            robot.name,
            kind.name,
            any(rule in kind.rules for rule, _ in planted - intact),
            tuple({rule for rule, level in more if rule in kind.rules or level is Severity.ERROR}),
            tuple({rule for rule, level in worse if level is Severity.ERROR}),
        )


def results(seed: int, words: str = "") -> Iterator[Result]:
    """Plant the faults in the robots that are there; only kinds with `words` in their names."""
    tasks = [
        (number, place, seed)
        for number, robot in enumerate(ROBOTS)
        if robot.origin is not None
        for place, kind in enumerate(robot.kinds)
        if words in kind.name
    ]
    with ProcessPoolExecutor() as pool:
        found = pool.map(repaired, *zip(*tasks, strict=True))
        yield from (result for result in found if result is not None)


def main() -> int:
    """Print what is not repaired, and the totals."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    found = list(results(options.seed, options.only))
    if not found:
        print("no robots: SUBT_CHECK_CORPUS and SUBT_CHECK_MODERN name no folders of them")
        return 2
    for result in found:
        if result.left or result.worse or not result.found:
            seen = "" if result.found else " not found;"
            print(f"{result.robot}: {result.kind}:{seen} left {result.left}, worse {result.worse}")
    for robot, number in Counter(result.robot for result in found).items():
        print(f"{robot}: {number} faults")
    good = sum(result.found and not result.left for result in found)
    worse = sum(bool(result.worse) for result in found)
    print(f"{len(found)} faults: {good / len(found):.0%} repaired, {worse} worse")
    return int(good < GOAL * len(found) or worse > 0)


if __name__ == "__main__":
    sys.exit(main())
