"""A hundred clients that upload at once: how long they wait for their answer, and what it takes.

Each sends a package of 1 MB of its own. Then all checks are waited for: each ends with one report
of its own upload. Run with `python -m bench.uploads [--postgres] [--clients N]` from the top
folder, as `make bench` does. Machines differ and are shared: see the load that is printed.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import threading
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from time import perf_counter

from bench.service import Client, Upload, noise, say, show, watched
from bench.static import ROOT, keep_bytecode
from tests.postgres import fresh_database, started
from tests.web.service import service, zip_of

SAMPLE = ROOT / "samples/subtcheck_buggy_sensor_config_1"
CREATED, MEGABYTES = 201, 1.0
ENDS = ("done", "refused", "failed", "cancelled")
P95_LIMIT = 1.0
"""Seconds until an upload is answered."""


def contents(number: int, folder: Path) -> list[bytes]:
    """Return so many archives of one robot, each with a texture of its own."""
    made = []
    for n in range(number):
        texture = {f"{SAMPLE.name}/materials/textures/noise.png": noise(n, MEGABYTES)}
        made.append(zip_of([SAMPLE], folder / "made.zip", texture).read_bytes())
    return made


def name_of(number: int) -> str:
    """Return under which name a client sends its package."""
    return f"robot_{number}.zip"


def all_at_once(client: Client, packages: Sequence[bytes]) -> list[Upload]:
    """Upload all packages at the same moment, each from a thread of its own."""
    ready = threading.Barrier(len(packages))

    def upload(number: int) -> Upload:
        ready.wait()
        return client.upload(name_of(number), packages[number])

    with ThreadPoolExecutor(len(packages)) as threads:
        return list(threads.map(upload, range(len(packages))))


def faults(client: Client, number: int, id: str) -> Iterator[str]:
    """Yield what is wrong with a check that is over; nothing should be."""
    told = list(client.events(id))
    if [each["number"] for each in told] != list(range(1, len(told) + 1)):
        yield "events doubled or missing"
    if sum(each["stage"] in ENDS for each in told) != 1:
        yield "ended more or less than once"
    if told[-1]["stage"] != "done":
        yield f"{told[-1]['stage']}: {told[-1]['words']}"
    elif name_of(number) not in client.report(id)["packages"][0]["path"]:
        yield "report of another package"


def first_static(client: Client, ids: Sequence[str]) -> float:
    """Return how long after the first order the first static findings were there, seconds."""
    told = [event for id in ids for event in client.events(id)]
    found = [event["time"] for event in told if event["data"].get("result")]
    return float(min(found) - min(event["time"] for event in told))


def show_answers(uploads: Sequence[Upload]) -> None:
    """Print how uploads were answered."""
    times = [each.seconds for each in uploads]
    percentile = statistics.quantiles(times, n=100, method="inclusive")
    show("an upload is answered, median", percentile[49], "s")
    show("  95th percentile", percentile[94], "s", P95_LIMIT)
    show("  slowest", max(times), "s")
    for status, number in Counter(each.status for each in uploads).items():
        print(f"  answered {status}: {number}")


def measure(client: Client, packages: Sequence[bytes]) -> None:
    """Upload, wait for everything, and print the figures."""
    show("load before", os.getloadavg()[0], "")
    with watched() as memory:
        begun = perf_counter()
        uploads = all_at_once(client, packages)
        show_answers(uploads)
        taken = {n: each.id for n, each in enumerate(uploads) if each.status == CREATED}
        say("waits for all checks")
        client.ends(taken.values())
        show("all checks are over", perf_counter() - begun, "s")
    show("static findings of the first one", first_static(client, [*taken.values()]), "s")
    wrong = Counter(fault for n, id in taken.items() for fault in faults(client, n, id))
    print(f"{'lost, doubled or mixed up':<44} {dict(wrong) or 'none'}")
    show("memory of the web process, most", memory.web, "MB")
    show("memory of all processes together, most", memory.all, "MB")


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=100)
    parser.add_argument("--postgres", action="store_true", help="instead of SQLite")
    options = parser.parse_args()
    keep_bytecode()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        packages = contents(options.clients, folder)
        more = {}
        if options.postgres:
            more["SUBT_CHECK_DATABASE_URL"] = fresh_database(stack.enter_context(started()))
        address = stack.enter_context(service(folder / "data", more, workers=2))
        measure(Client(address), packages)


if __name__ == "__main__":
    main()
