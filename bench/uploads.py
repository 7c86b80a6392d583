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
from collections.abc import Sequence
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
P95_LIMIT, STATIC_LIMIT = 1.0, 2.0
"""Seconds until an upload is answered, and until the first of them has static findings."""


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


def lost_or_doubled(client: Client, uploads: Sequence[Upload]) -> Counter[str]:
    """Count what is wrong with checks that are over; nothing should be."""
    wrong: Counter[str] = Counter()
    for number, upload in enumerate(uploads):
        told = list(client.events(upload.id))
        wrong["ended otherwise than done"] += told[-1]["stage"] != "done"
        wrong["reported more or less than once"] += (
            sum(each["stage"] == "done" for each in told) != 1
        )
        wrong["events out of order"] += [each["number"] for each in told] != list(
            range(1, len(told) + 1)
        )
        report = client.report(upload.id)
        wrong["report of another"] += name_of(number) not in report["packages"][0]["path"]
    return +wrong


def first_static(client: Client, id: str) -> float:
    """Wait for the static findings of a check, and return when that was."""
    for event in client.events(id):
        if event["data"].get("result"):
            break
    return perf_counter()


def measure(client: Client, packages: Sequence[bytes]) -> None:
    """Upload, wait for everything, and print the figures."""
    before = os.getloadavg()[0]
    with watched() as memory:
        begun = perf_counter()
        uploads = all_at_once(client, packages)
        times = [each.seconds for each in uploads]
        percentile = statistics.quantiles(times, n=100, method="inclusive")
        show("load before", before, "")
        show("an upload is answered, median", percentile[49], "s")
        show("  95th percentile", percentile[94], "s", P95_LIMIT)
        show("  slowest", max(times), "s")
        for status, number in Counter(each.status for each in uploads).items():
            print(f"  answered {status}: {number}")
        taken = [each for each in uploads if each.status == CREATED]
        say("waits for all checks")
        client.ends([each.id for each in taken])
        show("all checks are over", perf_counter() - begun, "s")
    wrong = lost_or_doubled(client, taken)
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
