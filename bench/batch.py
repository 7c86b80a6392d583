"""A batch of packages on PostgreSQL: the time with several workers and with one.

Each package is the robot of a real one, made slightly heavier, so that every check has its own
trial; each number of workers begins with an empty database, store and cache. A check keeps more
than one processor busy at times, and so each worker is given its own (`compose.yaml` gives them
their own containers): with any number of processors, one worker would take those of the other. More
workers than processors share them. For each check, the use of processors, of the database and of
the disk is printed, too. Run with `python -m bench.batch [--packages N]` from the top folder, as
`make bench` does; SUBT_CHECK_CORPUS names the folder of real packages, the samples are used where
there is none.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import sqlalchemy as sa

from bench.service import Client, other_robot, say, show
from bench.static import ROOT, keep_bytecode, real_packages
from checker.service.jobs.durable.database import open_database
from support.postgres import fresh_database, started
from support.service import service, zip_of

RATIO_LIMIT = 0.6
"""Greatest time of two workers, as a share of that of one."""


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
    """Run a worker on its own processor."""
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


@dataclass(frozen=True)
class Taken:
    """Resources that a batch used until its last report was there.

    Attributes:
        seconds: Seconds of real time from the start of the workers.
        processor: Seconds of processors, of all processes of the service.
        rows: Rows that the database wrote.
        log: Bytes that the database wrote ahead.
        database: Bytes by which it grew.
        stored: Bytes of uploads, results and parts.
    """

    seconds: float
    processor: float
    rows: int
    log: int
    database: int
    stored: int


def taken(workers: int, packages: Sequence[tuple[str, bytes]], folder: Path, url: str) -> Taken:
    """Return what so many workers take."""
    engine, before = open_database(url), _processor()
    with ExitStack() as stack:
        more = {"SUBT_CHECK_DATABASE_URL": url}
        client = Client(stack.enter_context(service(folder / "data", more, workers=0)))
        ids = [client.upload(name, content).id for name, content in packages]
        figures, begun = _figures(engine), perf_counter()
        for number in range(workers):
            stack.enter_context(worker(number, folder / "data", url))
        over = client.ends(ids)
        took = perf_counter() - begun
        after = _figures(engine)
    stages = Counter(state["stage"] for state in over.values())
    say(f"{workers} at work: {took:.1f} s, {dict(stages)}")
    engine.dispose()
    of_database = (now - then for now, then in zip(after, figures, strict=True))
    stored = sum(path.stat().st_size for path in (folder / "data").rglob("*") if path.is_file())
    return Taken(took, _processor() - before, *of_database, stored)


def _processor() -> float:
    """Return the seconds that processes which have ended took, with those below them."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _figures(engine: sa.Engine) -> tuple[int, int, int]:
    """Return rows written, bytes written ahead and bytes of a database of PostgreSQL."""
    query = """SELECT tup_inserted + tup_updated + tup_deleted, pg_current_wal_lsn() - '0/0',
        pg_database_size(datname) FROM pg_stat_database WHERE datname = current_database()"""
    with engine.connect() as connection:
        rows, log, size = connection.exec_driver_sql(query).one()
    return int(rows), int(log), int(size)


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--packages", type=int, default=60)
    number = parser.parse_args().packages
    keep_bytecode()
    took: dict[int, Taken] = {}
    with tempfile.TemporaryDirectory() as folder, started() as server:
        packages = archives(number, Path(folder))
        for workers in (1, 2, 4):
            place = Path(folder) / str(workers)
            place.mkdir()
            took[workers] = each = taken(workers, packages, place, fresh_database(server))
            show(f"{number} packages, {workers} at work", each.seconds, "s")
            show("  checks an hour", number / each.seconds * 3600, "")
            show("  load after", os.getloadavg()[0], "")
    each = took[2]
    show("a check: seconds of processors", each.processor / number, "s")
    show("  rows that the database writes", each.rows / number, "")
    show("  written ahead by it", each.log / number / 1e3, "kB")
    show("  by which it grows", each.database / number / 1e3, "kB")
    show("  stored: upload, result, parts", each.stored / number / 1e3, "kB")
    show("two against one", took[2].seconds / took[1].seconds, "", RATIO_LIMIT)
    show("four against one", took[4].seconds / took[1].seconds, "")


if __name__ == "__main__":
    main()
