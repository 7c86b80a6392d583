"""Measure the cost of a report: added time, size, and how long a browser takes to open it.

Run with `python -m bench.report` from the top folder, as `make bench` does; SUBT_CHECK_CORPUS names
the folder of real packages, without it, the samples are used; arguments choose some by name. Each
figure is the median of three runs. Machines differ and are shared: compare ratios, not
milliseconds.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter

from msgspec.structs import astuple

from bench.machine import pace, undisturbed
from bench.static import ROOT, keep_bytecode, real_packages
from support.browser import started

SIZE_LIMIT, EXTRA_LIMIT, OPEN_LIMIT = 10.0, 2.0, 3.0
"""MB of a report, seconds on top of the check, seconds until the robot is seen."""
REPEATS = 3


@dataclass(frozen=True)
class Cost:
    """The cost of one package.

    Attributes:
        cold: Seconds on top of the check when nothing is in the cache.
        warm: The same when meshes, views and the trial are.
        again: The same when a report was made before.
    """

    name: str
    cold: float
    warm: float
    again: float
    megabytes: float
    opening: float


def seconds(package: Path, cache: Path, *more: str) -> float:
    """Return how long the command takes in its own process."""
    begun = perf_counter()
    subprocess.run(
        [sys.executable, "-m", "checker.cli", str(package), *more],
        cwd=ROOT, capture_output=True, check=False,
        env={**os.environ, "SUBT_CHECK_CACHE": str(cache)},
    )  # fmt: skip
    return perf_counter() - begun


def opening(page: Path) -> float:
    """Return how long a browser takes until it shows the robot."""
    with started() as browser:
        tab = browser.new_page()
        begun = perf_counter()
        tab.goto(page.as_uri())
        tab.wait_for_function("() => window.subtCheckStage !== undefined")
        return perf_counter() - begun


def median(package: Path) -> Cost:
    """Measure one package several times, and take the median of each figure."""
    costs = [undisturbed(partial(measured, package)) for _ in range(REPEATS)]
    _, *figures = zip(*map(astuple, costs), strict=True)
    return Cost(package.name, *map(statistics.median, figures))


def measured(package: Path) -> Cost:
    """Measure one package once."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        target = folder / "out"
        report = ("--report", str(target))
        plain, full, before = folder / "plain", folder / "full", folder / "before"
        check = seconds(package, plain)
        cold = seconds(package, full, *report) - check
        seconds(package, before)
        # Other settings, so that no whole report is recalled.
        checked = seconds(package, before, "--fail-on", "warning")
        warm = seconds(package, before, "--fail-on", "warning", *report) - checked
        again = seconds(package, before, "--ignore", "PKG001", *report) - checked
        page = target / "report.html"
        return Cost(package.name, cold, warm, again, page.stat().st_size / 1e6, opening(page))


def main() -> None:
    """Measure and print everything."""
    keep_bytecode()
    costs = []
    print(f"pace {pace():.0f} ms")
    print(f"{'':<36} {'cold':>7} {'warm':>7} {'again':>7} {'MB':>6} {'open':>6}")
    chosen = sys.argv[1:]
    for package in real_packages():
        if chosen and package.name not in chosen:
            continue
        cost = median(package)
        costs.append(cost)
        times = f"{cost.cold:7.2f} {cost.warm:7.2f} {cost.again:7.2f}"
        print(f"{cost.name:<36} {times} {cost.megabytes:6.2f} {cost.opening:6.2f}", flush=True)
    for name, values, limit in (
        ("time on top, cold, s", [each.cold for each in costs], EXTRA_LIMIT),
        ("time on top, warm, s", [each.warm for each in costs], EXTRA_LIMIT),
        ("time on top, again, s", [each.again for each in costs], EXTRA_LIMIT),
        ("size, MB", [each.megabytes for each in costs], SIZE_LIMIT),
        ("opening, s", [each.opening for each in costs], OPEN_LIMIT),
    ):
        judged = "yes" if max(values) <= limit else "NO"
        middle = statistics.median(values)
        print(f"{name:<24} median {middle:.2f}, most {max(values):.2f} (≤ {limit:g}: {judged})")


if __name__ == "__main__":
    main()
