"""Many pages that follow one check: what they cost the web process, and how late events are there.

Two hundred streams follow a check to which something happens twice a second, then one to which
nothing happens, whose pages look by themselves now and then. Run with
`python -m bench.watchers [--postgres] [--watchers N]` from the top folder, as `make bench` does.
Machines differ and are shared: see the pace that is printed.
"""

from __future__ import annotations

import asyncio
import os
import statistics
import tempfile
from collections.abc import AsyncIterator, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from time import perf_counter, time
from urllib.parse import urlsplit

import sqlalchemy as sa

from bench.machine import pace
from bench.service import Client, below, of_service, options_of, show
from checker.service.jobs.durable.changes import tell
from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.tables import CHECKS, EVENTS, key_of_check
from tests.postgres import fresh_database, started
from tests.web.service import service

PROCESSOR_LIMIT, LATE_LIMIT = 20.0, 0.2
"""Percent of a processor, and seconds."""
MEASURED_SECONDS = 15.0
BETWEEN_SECONDS = 0.5
PAGE_SECONDS = 10.0
"""Between two looks of a page to which nothing is told (`MEANWHILE` in templates/web/watch.js)."""
PER_ADDRESS = 20
"""Streams of one address: those of this machine are many."""
MODEL = b'<sdf version="1.6"><model name="a"/></sdf>'


def processor_seconds(pid: int) -> float:
    """Return what a process has used of processors so far."""
    fields = Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(") ")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def web_process() -> int:
    """Return the id of the web process below this one."""
    [found] = of_service(below(os.getpid()), "web")
    return found


class Check:
    """A check to which things happen when the bench wants it."""

    def __init__(self, database: str, id: str) -> None:
        self._engine, self._key = open_database(database), key_of_check(id)
        self._number = 1

    def happen(self) -> None:
        """Write down that something happened, as a worker does."""
        self._number += 1
        event = {"number": self._number, "key": f"n{self._number}", "stage": "queued"}
        with self._engine.begin() as connection:
            connection.execute(
                sa.insert(EVENTS).values(
                    check_id=self._key, words="goes on", time=time(), data={}, **event
                )
            )
            connection.execute(
                sa.update(CHECKS).where(CHECKS.c.id == self._key).values(words="goes on")
            )
            tell(connection, self._key)


async def watch(address: str, id: str, number: int, late: list[float]) -> None:
    """Follow a check for ever, and note how late each event is."""
    async for line in answered(address, f"/api/checks/{id}/events?after=1", number):
        if line.startswith(b"data: "):
            told = float(line.partition(b'"time": ')[2].partition(b",")[0])
            late.append(time() - told)


async def look(address: str, id: str, number: int, watchers: int) -> None:
    """Fetch the page of a check now and then for ever, each watcher at another moment."""
    await asyncio.sleep(PAGE_SECONDS * number / watchers)
    while True:
        async for _ in answered(address, f"/checks/{id}", number):
            pass
        await asyncio.sleep(PAGE_SECONDS)


async def answered(address: str, path: str, number: int) -> AsyncIterator[bytes]:
    """Yield the lines of an answer; some watchers share an address."""
    host, _, port = urlsplit(address).netloc.rpartition(":")
    mine = (f"127.0.0.{2 + number // PER_ADDRESS}", 0)
    reader, writer = await asyncio.open_connection(host, int(port), local_addr=mine)
    writer.write(f"GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
    status = await reader.readline()
    if b" 200 " not in status:
        raise SystemExit(f"{path} is refused: {status!r}")
    async for line in reader:
        yield line
    writer.close()


async def measured(address: str, id: str, watchers: int, check: Check | None) -> list[float]:
    """Print what watchers cost, and return how late events were; None has nothing happen."""
    late: list[float] = []
    tasks = [asyncio.create_task(watch(address, id, n, late)) for n in range(watchers)]
    if check is None:
        tasks += [asyncio.create_task(look(address, id, n, watchers)) for n in range(watchers)]
    await asyncio.sleep(5.0)
    web = web_process()
    began, used = perf_counter(), processor_seconds(web)
    while perf_counter() - began < MEASURED_SECONDS:
        if check is not None:
            await asyncio.to_thread(check.happen)
        await asyncio.sleep(BETWEEN_SECONDS)
    share = 100 * (processor_seconds(web) - used) / (perf_counter() - began)
    what = "streams, events twice a second" if check is not None else "pages, nothing happens"
    show(f"{watchers} {what}", share, "% of a processor", PROCESSOR_LIMIT)
    for task in tasks:
        if task.done():
            task.result()
        task.cancel()
    return late


def show_late(late: list[float], watchers: int) -> None:
    """Print how late events were."""
    show("an event is told, median", statistics.median(late), "s")
    show("  99th percentile", statistics.quantiles(late, n=100)[98], "s", LATE_LIMIT)
    show("  slowest", max(late), "s")
    print(f"  events told to {watchers} watchers: {len(late)}")


@contextmanager
def serving(*, postgres: bool) -> Iterator[tuple[str, str]]:
    """Start a service without workers, and yield its address and that of its database."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory())) / "data"
        database = f"sqlite:///{folder}/jobs.sqlite"
        if postgres:
            database = fresh_database(stack.enter_context(started()))
        variables = {"SUBT_CHECK_DATABASE_URL": database}
        yield stack.enter_context(service(folder, variables, workers=0)), database


def main() -> None:
    """Measure and print everything."""
    parser = options_of(__doc__)
    parser.add_argument("--watchers", type=int, default=200)
    options = parser.parse_args()
    show("pace", pace(), "ms")
    with serving(postgres=options.postgres) as (address, database):
        id = Client(address).upload("robot.sdf", MODEL).id
        check = Check(database, id)
        late = asyncio.run(measured(address, id, options.watchers, check))
        show_late(late, options.watchers)
        other = Client(address).upload("other.sdf", MODEL + b" ").id
        asyncio.run(measured(address, other, options.watchers, None))


if __name__ == "__main__":
    main()
