"""Speed and memory of the trial: medians, on real packages and on the samples.

Run with `make bench`; SUBT_CHECK_CORPUS names the folder of real packages, there are the samples
without it. Machines differ and are shared: compare ratios, not milliseconds.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter

from bench.oracle import robots_in
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.mjcf.scene import build_scene
from checker.physics.trial.run import TIMESTEP
from checker.physics.trial.worker import run_trial

ROOT = Path(__file__).parent.parent
SAMPLES = ROOT / "samples"
COMMAND = [sys.executable, "-m", "checker.cli"]
SAMPLE = SAMPLES / "husky_migration_sensor_config_1"
REPEATS = 5


def seconds(action: Callable[[], object], repeats: int = REPEATS) -> float:
    """Return the median time of an action."""
    times = []
    for _ in range(repeats):
        started = perf_counter()
        action()
        times.append(perf_counter() - started)
    return statistics.median(times)


def command(cache: Path, *arguments: str) -> Callable[[], object]:
    """Return the action that runs the command in its own process, with a cache folder."""
    return lambda: subprocess.run(
        [*COMMAND, *arguments],
        cwd=ROOT, env={**os.environ, "SUBT_CHECK_CACHE": str(cache)}, capture_output=True,
        check=False,
    )  # fmt: skip


def folders() -> list[Path]:
    """Return the folders of packages: the corpus where there is one, and the samples."""
    corpus = os.environ.get("SUBT_CHECK_CORPUS")
    return [*([Path(corpus)] if corpus else []), SAMPLES]


def robots() -> Iterator[tuple[str, Robot]]:
    """Yield the robots of all packages, with the names of these."""
    for folder in folders():
        yield from ((package.name, robot) for package, robot in robots_in(folder))


def trial_of(robot: Robot) -> Callable[[], object] | None:
    """Return the action that drives a robot within this process; None for one that cannot."""
    plan = plan_of(robot)
    servos = (*plan.speeds, *plan.places)
    scene = build_scene(robot, servos=servos, belts=[belt.link for belt in plan.belts])
    if scene.unusable:
        return None
    return lambda: run_trial(scene, plan, TIMESTEP)


def show(name: str, value: float, remark: str = "") -> None:
    """Print a figure."""
    print(f"{name:<46} {value:8.3f} s{remark}", flush=True)


def show_trials() -> None:
    """Print how long each robot's trial takes once MuJoCo is loaded, by the kind of drive."""
    by_kind: dict[str, list[float]] = defaultdict(list)
    for name, robot in robots():
        trial = trial_of(robot)
        if trial is None:
            print(f"{name:<46}  no trial")
            continue
        trial()
        took = seconds(trial)
        by_kind[str(robot.locomotion.kind)].append(took)
        show(name, took, f"  {robot.locomotion.kind}")
    for kind, times in sorted(by_kind.items()):
        show(f"  {kind}: median of {len(times)}", statistics.median(times))
        print(f"{'':<46} {min(times):8.3f} to {max(times):.3f} s")


def show_commands(folder: Path) -> None:
    """Print how long the command takes, for one package and for all."""
    one, many = str(SAMPLE), str(folders()[0])
    number = len(list(folders()[0].glob("*/package.xml")))
    cold = [seconds(command(folder / f"cold{n}", one), 1) for n in range(REPEATS)]
    show("one package, cold, with trial", statistics.median(cold))
    show("  without trial", seconds(command(folder / "none", one, "--no-trial", "--no-cache")))
    kept = folder / "kept"
    command(kept, one)()
    show("  unchanged, from the cache", seconds(command(kept, one)))
    both = command(kept, many, "--jobs", "2")
    show(f"{number} packages, --jobs 2, cold", seconds(both, 1))
    show("  again, from the cache", seconds(both, 1))


def main() -> None:
    """Measure and print everything."""
    # The processes that are measured keep compiled sources, as those of users do.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    with tempfile.TemporaryDirectory() as folder:
        show_commands(Path(folder))
    # Before this process drives itself: the figure is the largest of all processes below it.
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{'memory, the largest process':<46} {peak:8.0f} MB")
    show_trials()


if __name__ == "__main__":
    main()
