"""Many pages that follow checks: the load of the web process, and the delay of events.

Two hundred streams follow twenty checks, to one of which something happens twice a second, then one
to which nothing happens, whose pages look by themselves now and then. Run with
`python -m bench.watchers [--postgres] [--watchers N]` from the top folder, as `make bench` does.
Machines differ and are shared: see the pace that is printed.
"""

from __future__ import annotations

import asyncio
import os
import statistics
import tempfile
from collections import deque
from collections.abc import AsyncIterator, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from time import perf_counter, time
from urllib.parse import urlsplit

from msgspec.structs import replace

from bench.machine import pace
from bench.service import Client, of_service, options_of, show
from checker.base.sandbox.usage import descendant_ids
from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.receipts import key_of_check
from support.postgres import fresh_database, started
from support.service import service

PROCESSOR_LIMIT, LATE_LIMIT = 20.0, 0.8
"""Percent of a processor, and seconds."""
MEASURED_SECONDS = 15.0
BETWEEN_SECONDS = 0.5
CHECKS = 20
PAGE_SECONDS = 10.0
"""Seconds between two requests of a page without events (`MEANWHILE` in templates/web/watch.js)."""
PER_ADDRESS = 20
"""Streams of one address: those of this machine are many."""
MODEL = b'<sdf version="1.6"><model name="a"/></sdf>'


def processor_seconds(pid: int) -> float:
    """Return what a process has used of processors so far."""
    fields = Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(") ")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def web_process() -> int:
    """Return the id of the web process below this one."""
    [found] = of_service(descendant_ids(os.getpid()), "web")
    return found


class Followed:
    """Checks whose events the bench triggers.

    Attributes:
        ids: The ids of the checks.
        happened: Time of the event of a number, for each check.
    """

    def __init__(self, database: str, ids: Sequence[str]) -> None:
        self.ids, self._checks = ids, prepare_database(open_database(database))
        self.happened: dict[tuple[str, int], float] = {}
        keys = {id: key_of_check(id) for id in ids}
        rows = self._checks.rows(keys.values())
        self._tasks = deque((id, rows[key][0].task) for id, key in keys.items())

    def happen(self) -> None:
        """Retry the check that has been idle the longest, as a worker does."""
        id, task = self._tasks.popleft()
        self.happened[id, 2 * task.number + 1] = time()
        self._checks.retry(task, "goes on")
        self._tasks.append((id, replace(task, number=task.number + 1)))


async def watch(address: str, number: int, followed: Followed, late: list[float]) -> None:
    """Follow one of the checks for ever, and note how late each event is."""
    id = followed.ids[number % len(followed.ids)]
    async for line in answered(address, f"/api/checks/{id}/events?after=1", number):
        received = time()
        if line.startswith(b"id: "):
            late.append(received - followed.happened[id, int(line[4:])])


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


async def measured(address: str, watchers: int, followed: Followed | str) -> list[float]:
    """Print what watchers cost, and return how late events were; to a check alone none happens."""
    late: list[float] = []
    if isinstance(followed, str):
        tasks = [asyncio.create_task(look(address, followed, n, watchers)) for n in range(watchers)]
    else:
        tasks = [asyncio.create_task(watch(address, n, followed, late)) for n in range(watchers)]
    await asyncio.sleep(5.0)
    web = web_process()
    began, used = perf_counter(), processor_seconds(web)
    while perf_counter() - began < MEASURED_SECONDS:
        if isinstance(followed, Followed):
            await asyncio.to_thread(followed.happen)
        await asyncio.sleep(BETWEEN_SECONDS)
    share = 100 * (processor_seconds(web) - used) / (perf_counter() - began)
    what = "streams, events twice a second" if late else "pages, nothing happens"
    show(f"{watchers} {what}", share, "% of a processor", PROCESSOR_LIMIT)
    for task in tasks:
        if task.done():
            task.result()
        task.cancel()
    return late


def show_late(late: list[float], watchers: int) -> None:
    """Print how late events were."""
    show("an event is received, median", statistics.median(late), "s")
    show("  99th percentile", statistics.quantiles(late, n=100)[98], "s", LATE_LIMIT)
    show("  slowest", max(late), "s")
    print(f"  events received to {watchers} watchers: {len(late)}")


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
        ids = [Client(address).upload(f"robot-{n}.sdf", MODEL).id for n in range(CHECKS)]
        late = asyncio.run(measured(address, options.watchers, Followed(database, ids)))
        show_late(late, options.watchers)
        other = Client(address).upload("other.sdf", MODEL + b" ").id
        asyncio.run(measured(address, options.watchers, other))


if __name__ == "__main__":
    main()
