"""A batch of packages on PostgreSQL: how much sooner two workers are through with it than one.

Each package is the robot of a real one, made a trifle heavier, so that every check drives its own;
each number of workers begins with an empty database, store and cache. A check keeps more than one
processor busy at times, and so each worker is given one of its own (`compose.yaml` gives them
containers of their own): with as many processors as it likes, one worker would take those of the
other. Run with `python -m bench.batch [--packages N]` from the top folder, as `make bench` does;
SUBT_CHECK_CORPUS names the folder of real packages, the samples stand in where there is none.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter

from bench.service import Client, other_robot, say, show
from bench.static import ROOT, keep_bytecode, real_packages
from tests.postgres import fresh_database, started
from tests.web.service import service, zip_of

RATIO_LIMIT = 0.6
"""Of the time of one worker, that two need."""


def archives(number: int, folder: Path) -> list[tuple[str, bytes]]:
    """Return names and contents of so many packages, all different."""
    found, made = real_packages(), []
    for n in range(number):
        package = shutil.copytree(found[n % len(found)], folder / found[n % len(found)].name)
        model = package / "model.sdf"
        if model.is_file():
            model.write_text(other_robot(model.read_text("utf-8"), n), "utf-8")
        (package / "bench.md").write_text(f"The {n}th of a bench.\n", "utf-8")
        archive = zip_of([package], folder / "made.zip")
        made.append((f"{package.name}_{n}.zip", archive.read_bytes()))
        shutil.rmtree(package)
    return made


@contextmanager
def worker(number: int, data: Path, url: str) -> Iterator[None]:
    """Run a worker on a processor of its own."""
    processors = sorted(os.sched_getaffinity(0))
    mine = {processors[number % len(processors)]}
    with (data.parent / f"worker{number}.log").open("w") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "checker.cli", "worker", "--data", str(data)],
            cwd=ROOT, env={**os.environ, "SUBT_CHECK_DATABASE_URL": url}, stderr=log,
            preexec_fn=lambda: os.sched_setaffinity(0, mine),  # noqa: PLW1509 - one call
        )  # fmt: skip
    try:
        yield
    finally:
        process.terminate()
        process.wait()


def seconds(workers: int, packages: Sequence[tuple[str, bytes]], folder: Path, url: str) -> float:
    """Return how long so many workers take, from their start until the last report is there."""
    from contextlib import ExitStack

    with ExitStack() as stack:
        more = {"SUBT_CHECK_DATABASE_URL": url}
        client = Client(stack.enter_context(service(folder / "data", more, workers=0)))
        ids = [client.upload(name, content).id for name, content in packages]
        begun = perf_counter()
        for number in range(workers):
            stack.enter_context(worker(number, folder / "data", url))
        over = client.ends(ids)
        took = perf_counter() - begun
    stages = Counter(state["stage"] for state in over.values())
    say(f"{workers} at work: {took:.1f} s, {dict(stages)}")
    return took


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--packages", type=int, default=60)
    number = parser.parse_args().packages
    keep_bytecode()
    took = {}
    with tempfile.TemporaryDirectory() as folder, started() as server:
        packages = archives(number, Path(folder))
        for workers in (1, 2):
            place = Path(folder) / str(workers)
            place.mkdir()
            took[workers] = seconds(workers, packages, place, fresh_database(server))
            show(f"{number} packages, {workers} at work", took[workers], "s")
            show("  load after", os.getloadavg()[0], "")
    show("two against one", took[2] / took[1], "", RATIO_LIMIT)


if __name__ == "__main__":
    main()
