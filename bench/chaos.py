"""A service whose processes are killed at random: the result of all that was uploaded.

A hundred robots are uploaded, each by a client that sends it again with the same key until it is
answered. Meanwhile workers, processes of checks, web servers, readers of archives and whole
services are killed, at least forty times. Each check has to end once, with the findings of the
rules and the trial of its own robot. Then the database is away for a minute, and the disk is full
for one. Run with `python -m bench.chaos [--postgres] [--uploads N] [--kills N]` from the top
folder: SQLite has one service of two workers, PostgreSQL two services of one worker each, with the
same data.
"""

from __future__ import annotations

import json
import os
import re
import signal
import sqlite3
import tempfile
import threading
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass
from io import BytesIO
from itertools import groupby
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import httpx

from bench.killer import Group, Killer
from bench.service import command_of, options_of, say, server_of, show
from bench.static import ROOT, keep_bytecode
from checker.base.sandbox.usage import descendant_ids
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import client_of, open_database
from checker.service.store.locks import lock_of_dead
from support.bucket import bucket_of, server_of_s3
from support.disk import full, small_disk
from support.postgres import fresh_database

SAMPLE = ROOT / "samples/subtcheck_buggy_sensor_config_1"
WHOLE = ["queued", "static", "trial", "done"]
"""Stages of the events of a check, each once."""
PATIENCE = 1_800.0
"""Seconds until an upload is taken, and until a hundred checks are over."""
ANSWER_SECONDS = 30.0
MINUTE = 60.0
_AT_ONCE = 50
"""Clients that upload."""
_SOON = 3.0
"""Seconds until checks are under way."""
_BEAT_FILES_SECONDS = 90.0
"""Time after which no files of ended processes may be in `incoming`."""


def robot(number: int) -> bytes:
    """Return the archive of a package with its own name and weight."""
    name, made = name_of(number), BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(SAMPLE.rglob("*")):
            if path.is_file():
                inner = path.relative_to(SAMPLE).as_posix()
                content = path.read_bytes().replace(SAMPLE.name.encode(), name.encode())
                if inner == "model.sdf":
                    content += f"<!-- {number} -->".encode()
                archive.writestr(f"{name}/{inner}", content)
    return made.getvalue()


def name_of(number: int) -> str:
    """Return the name of a package, by which its report is known."""
    return f"chaos_robot_sensor_config_{number}"


# Clients that send until they are answered, and watch until the end.


def uploaded(groups: Sequence[Group], number: int) -> str:
    """Send a robot, again and again with the same key, and return the id of its check."""
    content, ends = robot(number), monotonic() + PATIENCE
    headers = {"Idempotency-Key": f"chaos-{number:06}-{os.getpid():010}"}
    files = {"file": (f"{name_of(number)}.zip", content)}
    turn = number
    while monotonic() < ends:
        group = groups[turn % len(groups)]
        group.look()
        turn += 1
        with suppress(httpx.TransportError):
            answer = httpx.post(
                f"{group.address}/api/checks", files=files, headers=headers, timeout=ANSWER_SECONDS
            )
            if answer.status_code == 201:
                return str(answer.json()["id"])
            if answer.status_code not in (408, 429, 500, 502, 503, 504):
                raise SystemExit(f"an upload is refused: {answer.status_code} {answer.text}")
        sleep(0.5)
    raise SystemExit("an upload is never answered")


def _asked(groups: Sequence[Group], path: str) -> httpx.Response:
    ends, turn = monotonic() + PATIENCE, 0
    while monotonic() < ends:
        group = groups[turn % len(groups)]
        group.look()
        with suppress(httpx.TransportError):
            answer = httpx.get(group.address + path, timeout=ANSWER_SECONDS)
            if answer.status_code < 500:
                return answer
        turn += 1
        sleep(0.5)
    raise SystemExit(f"{path} is never answered")


def ended(groups: Sequence[Group], id: str, patience: float) -> Mapping[str, Any]:
    """Wait until a check is over, at most so many seconds, and return its state."""
    ends = monotonic() + patience
    while monotonic() < ends:
        state: Mapping[str, Any] = _asked(groups, f"/api/checks/{id}").json()
        if state.get("final"):
            return state
        sleep(1.0)
    raise SystemExit(f"a check does not end: {state}")


def faults(groups: Sequence[Group], number: int, id: str) -> Iterator[str]:
    """Yield what is wrong with a check that is over; nothing should be."""
    text = _asked(groups, f"/api/checks/{id}/events").text
    told = [json.loads(line[6:]) for line in text.splitlines() if line.startswith("data: ")]
    numbers = [event["number"] for event in told]
    if numbers != sorted(set(numbers)):
        yield "events doubled or in disorder"
    stages = [stage for stage, _ in groupby(event["stage"] for event in told)]
    if stages != WHOLE:
        yield f"its stages are {', '.join(stages)}: {told[-1]['words']}"
        return
    (package,) = _asked(groups, f"/api/checks/{id}/report.json").json()["packages"]
    if package["name"] != name_of(number):
        yield "the report of another robot"
    if not package["trial"]:
        yield "no trial"
    static = next(event for event in told if event["data"].get("result"))
    if static["stage"] != "trial":
        yield "no findings before the trial"
    if _asked(groups, f"/api/checks/{id}/report.html").status_code != 200:
        yield "no page"


def left_over(data: Path) -> list[str]:
    """Wait a while for the service to clean up, and return the working files that are left."""
    ends = monotonic() + _BEAT_FILES_SECONDS
    while (left := _at_work(data)) and monotonic() < ends:
        sleep(1.0)
    return left


def _at_work(data: Path) -> list[str]:
    """Return what is in `incoming` without an owner: waiting processes have a folder each."""
    left = []
    for path in (data / "incoming").iterdir():
        with suppress(OSError):
            if path.is_file():
                with lock_of_dead(path) as is_dead:
                    left += [path.name] if is_dead else []
    return left


def number_of_checks(group: Group) -> int:
    """Return how many checks the database knows."""
    engine = open_database(group.database or f"sqlite:///{group.data}/jobs.sqlite")
    found = {row.task.key for row in Checks(engine, client_of(engine)).all_rows()}
    engine.dispose()
    return len(found)


# What happens to the service meanwhile.


@contextmanager
def database_away(group: Group, server: int) -> Iterator[None]:
    """Stop the database from answering for a while.

    Args:
        group: The services that use it.
        server: The process of PostgreSQL, which is paused; 0 for SQLite, which is locked.
    """
    if server:
        with standing_still(server):
            yield
        return
    with closing(sqlite3.connect(group.data / "jobs.sqlite", timeout=60)) as connection:
        connection.execute("BEGIN IMMEDIATE")
        yield
        connection.rollback()


@contextmanager
def standing_still(process: int) -> Iterator[None]:
    """Pause a process, and all below it, for a while."""
    for pid in (process, *descendant_ids(process)):
        os.kill(pid, signal.SIGSTOP)
    try:
        yield
    finally:
        for pid in (process, *descendant_ids(process)):
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGCONT)


def away(group: Group, server: str, seconds: float) -> None:
    """Stop the database of a service from answering for a while, soon.

    Args:
        group: Uses it.
        server: Address of PostgreSQL; empty for SQLite.
        seconds: The duration.
    """
    sleep(_SOON)
    with database_away(group, server_process(server)):
        sleep(seconds)


def filled(group: Group, seconds: float) -> None:
    """Fill the disk of a service for a while, soon."""
    sleep(_SOON)
    with full(group.data):
        sleep(seconds)


@dataclass
class Trouble:
    """Faults of a run, with the counts of kills and results.

    Attributes:
        kills: The number of kills of each kind of process.
        ends: The number of checks with each result.
        faults: What is wrong with them.
        extra: Checks that were not ordered, or that are missing.
        left: Working files that were not deleted.
        seconds: Seconds until all checks ended.
    """

    kills: Counter[str]
    ends: Counter[str]
    faults: Counter[str]
    extra: int
    left: Sequence[str]
    seconds: float

    @property
    def is_none(self) -> bool:
        """True if there is no fault."""
        well = self.ends.keys() <= {"done"}
        return well and not (self.faults or self.extra or self.left)


def suffered(
    groups: Sequence[Group],
    uploads: int,
    kills: int = 0,
    pause: float = 4.0,
    meanwhile: Callable[[], None] = lambda: None,
) -> Trouble:
    """Upload robots, kill processes and cause other faults, and return the results.

    Args:
        groups: The running services, which share one store and database.
        uploads: Robots.
        kills: The number of killed processes.
        pause: Seconds between two kills.
        meanwhile: What else happens, once all uploads are on their way.
    """
    before, begun = number_of_checks(groups[0]), monotonic()
    killer, over = Killer(groups, kills, pause), threading.Event()
    numbers = range(before, before + uploads)
    with ThreadPoolExecutor(min(uploads, _AT_ONCE) + 2) as threads:
        murder = threads.submit(killer.run, over.is_set)
        other = threads.submit(meanwhile)
        ids = dict(zip(numbers, threads.map(lambda n: uploaded(groups, n), numbers), strict=True))
        say(f"{len(ids)} uploads are taken after {monotonic() - begun:.0f} s")
        patience = PATIENCE * max(1, uploads // 100)
        ends = Counter(ended(groups, id, patience)["stage"] for id in ids.values())
        over.set()
        murder.result()
        other.result()
    wrong = Counter(fault for n, id in ids.items() for fault in faults(groups, n, id))
    extra = number_of_checks(groups[0]) - before - len(set(ids.values()))
    left = [each for data in {group.data for group in groups} for each in left_over(data)]
    return Trouble(killer.done, ends, wrong, extra, left, monotonic() - begun)


@contextmanager
def services(
    folder: Path, server: str, size: int = 0, bucket: Mapping[str, str] | None = None
) -> Iterator[list[Group]]:
    """Start one service on SQLite, or two on a PostgreSQL server, with three workers in all.

    Args:
        folder: Contains data and logs.
        server: Address of PostgreSQL; empty for SQLite.
        size: Bytes of the disk of the data; 0 for that of the folder.
        bucket: Variables that lead to one of S3, in place of a folder that services share.
    """
    with ExitStack() as stack:
        if size:
            stack.enter_context(small_disk(folder / "data", size))
        database = fresh_database(server) if server else ""
        groups = [
            Group(number, folder, database, workers, bucket or {})
            for number, workers in enumerate((2, 1) if server else (2,))
        ]
        for group in groups:
            group.start()
            stack.callback(group.stop)
        yield groups


def server_process(server: str) -> int:
    """Return the process of PostgreSQL that listens at an address; 0 without one."""
    port = re.search(r":(\d+)/", server)
    word = f"--port={port[1]}".encode() if port else b"none"
    pids = (int(path.name) for path in Path("/proc").glob("[0-9]*"))
    return next((pid for pid in pids if word in command_of(pid) and b"-D" in command_of(pid)), 0)


def _show(what: str, trouble: Trouble) -> None:
    print(what)
    if trouble.kills:
        print(f"  killed {trouble.kills.total()}:", _listed(trouble.kills))
    print("  ended:", _listed(trouble.ends))
    print("  wrong:", _listed(trouble.faults) or "nothing")
    print(f"  lost or doubled: {trouble.extra}; files left: {len(trouble.left)}")
    show("  until the last one was over", trouble.seconds, "s")


def _listed(counts: Counter[str]) -> str:
    return ", ".join(f"{number} {name}" for name, number in counts.most_common())


def main() -> None:
    """Cause all faults, and print the results."""
    parser = options_of(__doc__)
    parser.add_argument("--uploads", type=int, default=100)
    parser.add_argument("--kills", type=int, default=40)
    parser.add_argument("--pause", type=float, default=4.0, help="seconds between two kills")
    parser.add_argument("--s3", action="store_true", help="instead of a folder that all share")
    options = parser.parse_args()
    keep_bytecode()
    well = []
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        server = server_of(options, stack)
        bucket = bucket_of(stack.enter_context(server_of_s3())) if options.s3 else {}
        with services(folder, server, bucket=bucket) as groups:
            trouble = suffered(groups, options.uploads, options.kills, options.pause)
            _show("processes are killed at random", trouble)
            well.append(trouble.is_none and trouble.kills.total() >= options.kills)
            trouble = suffered(groups, 10, meanwhile=lambda: away(groups[0], server, MINUTE))
            _show("the database is away for a minute", trouble)
            well.append(trouble.is_none)
        (folder / "small").mkdir()
        with services(folder / "small", server, 700_000_000) as groups:
            trouble = suffered(groups, 10, meanwhile=lambda: filled(groups[0], MINUTE))
            _show("the disk is full for a minute", trouble)
            well.append(trouble.is_none)
    if not all(well):
        raise SystemExit("NO: something was lost, doubled, failed or left")


if __name__ == "__main__":
    main()
