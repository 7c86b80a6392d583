"""Compare the time of a check with that of similar tools, in pairs on one machine.

`make bench` prints the ratios. Peers: `ign sdf -k` (Debian's ignition-tools), which loads one SDF
file; catkin_lint, which reads the manifests of a package; and simcheck, which drops a URDF robot in
MuJoCo and PyBullet. They take turns, so that a slower machine slows both; the quoted figure
is the median of the ratios, by processor time of the processes that each waits for and by the
clock.
"""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import tempfile
import venv
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from time import perf_counter

from bench.static import COMMAND, ROOT, keep_bytecode, real_packages

PEERS = ("catkin_lint==1.6.25", "simcheck==0.2.0", "pybullet==3.2.7")
PAIRS = 7
LIMITS = {
    "never seen, against ign sdf -k": 1.5,
    "edited, against ign sdf -k": 1.5,
    "edited, with trial, against simcheck": 0.12,
}
"""Ratios that are meant not to be exceeded."""

Prepare = Callable[[], object]


def ratios(
    own: Sequence[str], peer: Sequence[str], prepare: Prepare, pairs: int = PAIRS
) -> list[tuple[float, float]]:
    """Time two commands in turns; return the ratios of processor time and of the clock.

    Args:
        own: Our command.
        peer: The other.
        prepare: Called before each of ours.
        pairs: The number of pairs, after one that warms the disk.
    """
    found = []
    for number in range(pairs + 1):
        prepare()
        ours, theirs = _time(own), _time(peer)
        if number:
            found.append((ours[0] / theirs[0], ours[1] / theirs[1]))
    return found


def show(name: str, found: Sequence[tuple[float, float]]) -> None:
    """Print the medians of the ratios with their limit."""
    processor, clock = map(statistics.median, zip(*found, strict=True))
    limit = LIMITS.get(name)
    judged = f"  (≤ {limit:g}: {'yes' if processor <= limit else 'NO'})" if limit else ""
    print(f"{name:<36} {processor:6.2f} × processor  {clock:6.2f} × clock{judged}", flush=True)


def _time(command: Sequence[str]) -> tuple[float, float]:
    before, started = os.times(), perf_counter()
    subprocess.run(
        command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False
    )
    took, after = perf_counter() - started, os.times()
    spent = after.children_user + after.children_system
    return spent - before.children_user - before.children_system, took


def peers(folder: Path) -> Path:
    """Install the peers that PyPI has into their own environment; return its programs."""
    venv.create(folder, with_pip=True)
    programs = folder / "bin"
    pip = [str(programs / "pip"), "install", "--quiet", "--disable-pip-version-check", *PEERS]
    subprocess.run(pip, check=True, stderr=subprocess.DEVNULL)
    return programs


def edited(model: Path) -> Prepare:
    """Return what changes a comment of a model, so that its report is not known."""
    text, versions = model.read_text("utf-8"), iter(range(10**6))
    return lambda: model.write_text(f"{text}<!-- {next(versions)} -->\n", "utf-8")


def main() -> None:
    """Measure and print every pair."""
    keep_bytecode()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        os.environ["SUBT_CHECK_CACHE"] = str(place / "cache")
        programs = peers(place / "peers")
        packages = [
            Path(shutil.copytree(path, place / path.name, symlinks=True))
            for path in real_packages()
            if (path / "model.sdf").is_file()
        ]
        static(max(packages, key=lambda path: path.name.startswith("x1_")), programs)
        driven = [pair for package in packages for pair in against_simcheck(package, programs)]
        show("edited, with trial, against simcheck", driven)


def static(package: Path, programs: Path) -> None:
    """Measure the static rules."""
    own = [*COMMAND, "-q", str(package), "--no-trial"]
    model = package / "model.sdf"
    if ign := shutil.which("ign"):
        loads = [ign, "sdf", "-k", str(model)]
        cache = Path(os.environ["SUBT_CHECK_CACHE"])
        forget = partial(shutil.rmtree, cache, ignore_errors=True)
        show("never seen, against ign sdf -k", ratios(own, loads, forget))
        show("edited, against ign sdf -k", ratios(own, loads, edited(model)))
        show("unchanged, against ign sdf -k", ratios(own, loads, lambda: None))
    else:
        print("ign is not installed (apt install ignition-tools): not measured")
    lint = [str(programs / "catkin_lint"), str(package)]
    show("edited, against catkin_lint", ratios(own, lint, edited(model)))


def against_simcheck(package: Path, programs: Path) -> list[tuple[float, float]]:
    """Measure a robot with its trial; nothing of one that cannot be written as URDF."""
    urdf = package.parent / f"{package.name}.urdf"
    export = [*COMMAND, "export", str(package), "--format", "urdf", "--output", str(urdf)]
    subprocess.run(export, cwd=ROOT, capture_output=True, check=False)
    model = package / "model.sdf"
    if not (urdf.is_file() and model.is_file()):
        return []
    drops = [str(programs / "simcheck"), "check", str(urdf), "--package-path", str(package.parent)]
    return ratios([*COMMAND, "-q", str(package)], drops, edited(model), 2)


if __name__ == "__main__":
    main()
