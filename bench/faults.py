"""Planted faults: is each found by the rules that must find it, and by no other rule?

Run with `python -m bench.faults [--once] [--seed N] [--only WORDS]` from the top folder. Faults are
planted one by one in three real submissions (SUBT_CHECK_CORPUS), in ROS 2 packages
(SUBT_CHECK_MODERN) and in one URDF file of PyPI's example-robot-data. `--once` plants each kind in
one robot only. Rules that do not exist yet cannot find anything, so every kind counts.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from lxml.etree import LxmlError

from bench.planted import launch, model, paperwork, ros2, sensors, shapes, spawner, urdf
from bench.planted.edits import Kind
from checker.pipeline import check_package
from checker.settings import Settings
from support.judgements import folder_of

Found = frozenset[tuple[str, str, str, str]]
"""Rules, files, elements and messages of findings."""

SUBMISSION = (
    *model.KINDS,
    *shapes.KINDS,
    *sensors.KINDS,
    *spawner.KINDS,
    *launch.KINDS,
    *paperwork.KINDS,
)


@dataclass(frozen=True)
class Robot:
    """A robot to plant faults in.

    Attributes:
        name: The name in the table.
        source: The source of its package.
        folder: The folder of its package, below the folder of the source.
        checked: The checked path below the package.
        home: The folder to copy the package to, so that its URIs resolve.
        profile: The profile of the check.
        kinds: Faults that can be planted in it.
    """

    name: str
    source: str
    folder: str
    checked: str
    home: str
    profile: str
    kinds: tuple[Kind, ...]

    @property
    def origin(self) -> Path | None:
        """Folder of its package; None if it does not exist."""
        root = folder_of(self.source)
        return root / self.folder if root and (root / self.folder).is_dir() else None


def submission(name: str, kinds: tuple[Kind, ...] = SUBMISSION) -> Robot:
    """Return a robot of the SubT challenge."""
    return Robot(name, "corpus", name, "", name, "subt", kinds)


def _ros2(name: str, repository: str) -> Robot:
    return Robot(name, "modern", f"{repository}/{name}", "", name, "ros2", ros2.KINDS)


TURTLEBOT = "nav2_minimal_tb3_sim"
ROBOTS = (
    submission("coro_jeanine_sensor_config_1"),
    submission("coro_rocky_sensor_config_1"),
    submission("explorer_ds1_sensor_config_1"),
    Robot(
        "turtlebot3_waffle.urdf",
        "modern",
        f"bugs/nav2-imu-joint/after/{TURTLEBOT}",
        "urdf/turtlebot3_waffle.urdf",
        TURTLEBOT,
        "urdf",
        urdf.KINDS,
    ),
    Robot(
        "ur5_robot.urdf",
        "urdf",
        "ur_description",
        "urdf/ur5_robot.urdf",
        "example-robot-data/robots/ur_description",
        "urdf",
        urdf.KINDS,
    ),
    _ros2("gz_ros2_control_demos", "gz_ros2_control"),
    _ros2("turtlebot3_gazebo", "turtlebot3_simulations"),
    _ros2("nav2_minimal_tb3_sim", "nav2_minimal_turtlebot_simulation"),
)


@dataclass(frozen=True)
class Result:
    """Result of a planted fault.

    Attributes:
        robot: Name of the robot.
        kind: Name of the kind.
        rules: The rules that had to find it.
        found: The rules that did.
        cascades: Other rules that report something new, with a message of each.
    """

    robot: str
    kind: str
    rules: tuple[str, ...]
    found: tuple[str, ...]
    cascades: tuple[tuple[str, str], ...]


def _findings(package: Path, robot: Robot) -> Found:
    settings = Settings(profile=robot.profile, profile_chosen=True, trial=False)
    report = check_package(package / robot.checked, settings)
    return frozenset(
        (finding.rule, place.file, place.element, place.message or finding.message)
        for checked in report.packages
        for finding in checked.findings
        for place in finding.places
        if not place.note
    )


def copy_package(robot: Robot, folder: str) -> Path:
    """Copy the package; of several URDF files only the one that is checked."""
    assert robot.origin is not None
    package = Path(folder) / robot.home
    shutil.copytree(robot.origin, package, symlinks=True)
    manifest = robot.origin.parents[1] / "package.xml"
    if manifest.is_file():  # the package that a URI names may be farther up
        shutil.copy(manifest, package.parents[1])
    for other in package.glob("urdf/*.urdf") if robot.checked else ():
        if other != package / robot.checked:
            other.unlink()
    return package


@cache
def _before(number: int) -> Found:
    with tempfile.TemporaryDirectory() as folder:
        return _findings(copy_package(ROBOTS[number], folder), ROBOTS[number])


def planted(numbers: tuple[int, ...], place: int, seed: int) -> Result | None:
    """Plant a fault and check.

    Args:
        numbers: The numbers of robots; the first that can have the fault gets it.
        place: The place of the kind among those of the robots.
        seed: The seed of the random choice of the place.

    Returns:
        None if no robot has anything that could have this fault.
    """
    for number in numbers:
        robot, kind = ROBOTS[number], ROBOTS[number].kinds[place]
        with tempfile.TemporaryDirectory() as folder:
            package = copy_package(robot, folder)
            try:
                is_there = kind.edit(package, Random(f"{seed} {robot.name} {kind.name}"))
            except (ValueError, LookupError, LxmlError) as error:
                raise RuntimeError(f"{kind.name}: {robot.name}: {error}") from None
            if is_there:
                return _result(robot, kind, _before(number), _findings(package, robot))
    return None


def _result(robot: Robot, kind: Kind, before: Found, after: Found) -> Result:
    found = tuple(sorted({rule for rule, *_ in after - before} & {*kind.rules}))
    known = {(rule, file, _without_numbers(message)) for rule, file, _, message in before}
    others = {
        rule: message
        for rule, file, _, message in sorted(after)
        if rule not in kind.rules and (rule, file, _without_numbers(message)) not in known
    }
    return Result(robot.name, kind.name, kind.rules, found, tuple(others.items()))


def _without_numbers(message: str) -> str:
    """Return what stays of a message when a fault that was there before has other figures."""
    return re.sub(r"[\d.]+", "#", message)


def results(seed: int, words: str = "", *, once: bool = False) -> list[Result]:
    """Plant the faults in the robots that are there.

    Args:
        seed: The seed of the random choices.
        words: Only kinds with these in their names.
        once: Each kind in one robot only, and the robots in turn.
    """
    groups: dict[tuple[Kind, ...], list[int]] = defaultdict(list)
    for number, robot in enumerate(ROBOTS):
        if robot.origin is not None:
            groups[robot.kinds].append(number)
    tasks = [
        (numbers, place, seed)
        for kinds, robots in groups.items()
        for place, kind in enumerate(kinds)
        if words in kind.name
        for numbers in ([_turned(robots, place)] if once else [(it,) for it in robots])
    ]
    with ProcessPoolExecutor() as pool:
        found = pool.map(planted, *zip(*tasks, strict=True), chunksize=4)
        return [result for result in found if result is not None]


def _turned(numbers: list[int], by: int) -> tuple[int, ...]:
    by %= len(numbers)
    return (*numbers[by:], *numbers[:by])


def table(found: list[Result]) -> Iterator[str]:
    """Yield a line for each rule: faults planted, found, and cascades."""
    planted_for: Counter[str] = Counter()
    found_by: Counter[str] = Counter()
    cascades: Counter[str] = Counter()
    for result in found:
        planted_for[result.rules[0]] += 1
        found_by[result.rules[0]] += bool(result.found)
        cascades.update({rule for rule, _ in result.cascades})
    yield f"{'rule':<8}{'planted':>8}{'found':>8}{'cascades':>10}"
    for rule in sorted({*planted_for, *cascades}):
        yield f"{rule:<8}{planted_for[rule]:>8}{found_by[rule]:>8}{cascades[rule]:>10}"


def main() -> int:
    """Print what is missed, what cascades, a line for each rule and the totals."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--once", action="store_true")
    options = parser.parse_args()
    found = results(options.seed, options.only, once=options.once)
    if not found:
        print("no robots: SUBT_CHECK_CORPUS and SUBT_CHECK_MODERN name no folders of them")
        return 2
    for result in found:
        if not result.found or result.cascades:
            others = "; ".join(f"{rule} {message}" for rule, message in result.cascades)
            by = ", ".join(result.found) or f"MISSED by {', '.join(result.rules)}"
            print(
                f"{result.robot}: {result.kind}: {by}" + (f"; CASCADE {others}" if others else "")
            )
    print(*table(found), sep="\n")
    hits, cascades = sum(bool(r.found) for r in found), sum(len(r.cascades) for r in found)
    kinds = len({result.kind for result in found})
    print(
        f"{kinds} kinds, {len(found)} faults: {hits / len(found):.1%} found, "
        f"{cascades / len(found):.2f} cascades a fault"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
