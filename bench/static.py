"""Speed and memory of the static rules: medians, on real packages and on generated robots.

What meshes contain, sensors see and xacro files expand to is in the cache; the rules run each time.
Run with `make bench`; SUBT_CHECK_CORPUS names the folder of real packages, the samples are used
where there is none. Machines differ and are shared: compare ratios, not milliseconds.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from time import perf_counter

from checker.base.cache import Cache, cache_folder
from checker.engine.review import findings_of
from checker.package.inputs import open_input
from checker.settings import Settings

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples/acme_scout"
STILL = Settings(trial=False)
COMMAND = [sys.executable, "-m", "checker.cli"]
_VERSION = "import subt_check.cli as cli; cli.main(['--version'])"
_TURNS = 11
LIMITS = {
    "a package, within a process": 0.15,
    "a package, cold process": 0.5,
    "--help": 0.15,
    "2000 links": 10.0,
}
"""Seconds that each figure is meant to stay below."""


def seconds(action: Callable[[], object], repeats: int = 5) -> float:
    """Return the median time of an action."""
    times = []
    for _ in range(repeats):
        started = perf_counter()
        action()
        times.append(perf_counter() - started)
    return statistics.median(times)


def cold(*arguments: str) -> Callable[[], object]:
    """Return the action that runs the command in its own process."""
    return lambda: subprocess.run(
        [*COMMAND, *arguments], cwd=ROOT, capture_output=True, check=False
    )


def robot_of(links: int, folder: Path) -> Path:
    """Write a package whose model is a chain of so many links."""
    package = folder / f"bench_chain{links}_sensor_config_1"
    package.mkdir()
    parts = "".join(
        f"<link name='l{n}'><pose>0 0 {n} 0 0 1.57</pose><inertial><mass>1</mass></inertial>"
        "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
        f"</collision></link>\n<joint name='j{n}' type='revolute'><parent>l{n - 1}</parent>"
        f"<child>l{n}</child><axis><xyz>0 0 1</xyz></axis></joint>\n"
        for n in range(1, links)
    )
    model = f"<sdf version='1.6'><model name='chain'><link name='l0'/>{parts}</model></sdf>"
    (package / "model.sdf").write_text(model, "utf-8")
    (package / "package.xml").write_text(f"<package><name>{package.name}</name></package>", "utf-8")
    return package


def show(name: str, value: float) -> None:
    """Print a figure with its limit."""
    limit = LIMITS.get(name)
    judged = f"  (≤ {limit:g} s: {'yes' if value <= limit else 'NO'})" if limit else ""
    print(f"{name:<32} {value:8.3f} s{judged}")


def keep_bytecode() -> None:
    """Make the measured processes keep compiled sources, as those of users do."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


def real_packages() -> list[Path]:
    """Return the packages of the corpus, else the samples."""
    folder = Path(os.environ.get("SUBT_CHECK_CORPUS") or ROOT / "samples")
    return sorted(path.parent for path in folder.glob("*/package.xml"))


def main() -> None:
    """Measure and print everything."""
    keep_bytecode()
    packages = real_packages()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SUBT_CHECK_CACHE"] = folder
        measure(packages)


def findings(path: Path) -> object:
    """Run all static rules over a package."""
    with open_input(path) as opened:
        return findings_of(opened.packages[0], STILL, Cache(cache_folder()))


def cold_starts() -> None:
    """Measure processes in turn, and print each as a multiple of `python -c pass`."""
    check = [*COMMAND, str(SAMPLE), "--no-trial"]
    with tempfile.TemporaryDirectory() as kept:
        actions = {
            "python -c pass": ([sys.executable, "-c", "pass"], ""),
            "--version": ([*COMMAND, "--version"], ""),
            "--version, by subt_check": ([sys.executable, "-c", _VERSION], ""),
            "first check, empty cache": (check, ""),
            "the same, no cache": ([*check, "--no-cache"], ""),
            "the same again": (check, kept),
        }
        times: dict[str, list[float]] = {name: [] for name in actions}
        for _ in range(1 + _TURNS):
            for name, (command, cache) in actions.items():
                times[name].append(seconds_of(command, cache))
    medians = {name: statistics.median(each[1:]) for name, each in times.items()}
    for name, value in medians.items():
        print(f"{name:<32} {value:8.3f} s {value / medians['python -c pass']:7.1f} ×")


def seconds_of(command: Sequence[str], cache: str) -> float:
    """Return the seconds that a command takes with a cache, a new one if none is named."""
    with tempfile.TemporaryDirectory() as new:
        run = partial(subprocess.run, cwd=ROOT, capture_output=True, check=False)
        return seconds(lambda: run(command, env=os.environ | {"SUBT_CHECK_CACHE": cache or new}), 1)


def measure(packages: list[Path]) -> None:
    """Measure and print everything, with its own cache."""
    for path in packages:
        findings(path)
    within = [seconds(lambda path=path: findings(path), 3) for path in packages]
    show("a package, within a process", statistics.median(within))
    print(f"{'  slowest of ' + str(len(packages)):<32} {max(within):8.3f} s")
    alone_times = [seconds(cold(str(path), "--no-trial"), 1) for path in packages]
    show("a package, cold process", statistics.median(alone_times))
    show("--help", seconds(cold("--help")))
    cold_starts()
    with tempfile.TemporaryDirectory() as folder:
        times = {}
        for links in (500, 1000, 2000, 4000):
            package = robot_of(links, Path(folder))
            times[links] = seconds(lambda path=package: findings(path), 1)
            show(f"{links} links", times[links])
    print(f"{'4000 links against 2000':<32} {times[4000] / times[2000]:8.2f} ×")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{'memory, all of the above':<32} {peak:8.0f} MB")
    alone = memory_of(packages[0])
    judged = "yes" if alone <= 200 else "NO"
    print(f"{'memory, one package':<32} {alone:8.0f} MB  (≤ 200 MB: {judged})")


def memory_of(package: Path) -> float:
    """Return the peak memory of one check in its own process, MB.

    It is read from /proc: the figure of `getrusage` is inherited from the parent.
    """
    code = (
        "import re, sys; from checker.cli import main; main([sys.argv[1]]);"
        "status = open('/proc/self/status').read();"
        "print(re.search(r'VmHWM:\\s+(\\d+)', status).group(1), file=sys.stderr)"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, str(package)],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return int(run.stderr.split()[-1]) / 1024


if __name__ == "__main__":
    main()
