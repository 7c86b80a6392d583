"""A hundred clients that upload at once: the time to an answer, and the use of resources.

Each sends its own package of 1 MB to a service that is new, five times over. All checks of the
last time are waited for: each ends with one report of its own upload. Run with
`python -m bench.uploads [--postgres] [--clients N]` from the top folder, as `make bench` does.
Machines differ and are shared: see the pace that is printed.
"""

from __future__ import annotations

import statistics
import tempfile
import threading
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from time import perf_counter, sleep

from bench.machine import pace
from bench.service import (
    Client,
    Upload,
    noise,
    options_of,
    say,
    server_of,
    show,
    variables_of,
    watched,
)
from bench.static import ROOT, keep_bytecode
from support.service import service, zip_of

SAMPLE = ROOT / "samples/subtcheck_buggy_sensor_config_1"
CREATED, MEGABYTES = 201, 1.0
ENDS = ("done", "refused", "failed", "cancelled")
P95_LIMIT = 1.0
"""Seconds until an upload is answered."""
REPEATS = 5
SETTLED = 3.0
"""Seconds that a service is given to load what it needs."""


def contents(number: int, folder: Path) -> list[bytes]:
    """Return so many archives of one robot, each with its own texture."""
    made = []
    for n in range(number):
        texture = {f"{SAMPLE.name}/materials/textures/noise.png": noise(n, MEGABYTES)}
        made.append(zip_of([SAMPLE], folder / "made.zip", texture).read_bytes())
    return made


def name_of(number: int) -> str:
    """Return under which name a client sends its package."""
    return f"robot_{number}.zip"


def all_at_once(client: Client, packages: Sequence[bytes]) -> list[Upload]:
    """Upload all packages at the same moment, each from its own thread."""
    ready = threading.Barrier(len(packages))

    def upload(number: int) -> Upload:
        ready.wait()
        return client.upload(name_of(number), packages[number])

    with ThreadPoolExecutor(len(packages)) as threads:
        return list(threads.map(upload, range(len(packages))))


def faults(client: Client, number: int, id: str) -> Iterator[str]:
    """Yield what is wrong with a check that is over; nothing should be."""
    events = list(client.events(id))
    numbers = [each["number"] for each in events]
    if numbers != sorted(set(numbers)):
        yield "events doubled or in disorder"
    if sum(each["stage"] in ENDS for each in events) != 1:
        yield "ended more or less than once"
    if events[-1]["stage"] != "done":
        yield f"{events[-1]['stage']}: {events[-1]['words']}"
    elif name_of(number) not in client.report(id)["packages"][0]["path"]:
        yield "report of another package"


def first_static(client: Client, ids: Sequence[str]) -> float:
    """Return how long after the first order the first static findings were there, seconds."""
    events = [event for id in ids for event in client.events(id)]
    found = [event["time"] for event in events if event["data"].get("result")]
    return float(min(found) - min(event["time"] for event in events))


def show_answers(times: Sequence[Sequence[Upload]]) -> None:
    """Print how uploads were answered, each figure the median of several times."""
    answers = [[each.seconds for each in uploads] for uploads in times]
    percentiles = [statistics.quantiles(each, n=100, method="inclusive") for each in answers]
    show("an upload is answered, median", statistics.median(p[49] for p in percentiles), "s")
    show("  95th percentile", statistics.median(p[94] for p in percentiles), "s", P95_LIMIT)
    show("  slowest", statistics.median(map(max, answers)), "s")
    print("  95th percentiles:", ", ".join(f"{p[94]:.2f}" for p in percentiles))
    for status, number in Counter(each.status for uploads in times for each in uploads).items():
        print(f"  answered {status}: {number}")


def waited_for(client: Client, uploads: Sequence[Upload], begun: float) -> None:
    """Wait until all checks are over, and print their results."""
    taken = {n: each.id for n, each in enumerate(uploads) if each.status == CREATED}
    say("waits for all checks")
    client.ends(taken.values())
    show("all checks are over", perf_counter() - begun, "s")
    show("static findings of the first one", first_static(client, [*taken.values()]), "s")
    wrong = Counter(fault for n, id in taken.items() for fault in faults(client, n, id))
    print(f"{'lost, doubled or mixed up':<44} {dict(wrong) or 'none'}")


def main() -> None:
    """Measure and print everything."""
    parser = options_of(__doc__)
    parser.add_argument("--clients", type=int, default=100)
    options = parser.parse_args()
    keep_bytecode()
    show("pace", pace(), "ms")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        packages = contents(options.clients, folder)
        server = server_of(options, stack)
        *before, last = range(REPEATS)
        times = []
        for number in before:
            with a_service(folder / f"data{number}", server) as client:
                times.append(all_at_once(client, packages))
        with a_service(folder / f"data{last}", server) as client, watched() as memory:
            begun = perf_counter()
            times.append(all_at_once(client, packages))
            show_answers(times)
            waited_for(client, times[-1], begun)
        show("memory of the web process, most", memory.web, "MB")
        show("memory of all processes together, most", memory.all, "MB")


@contextmanager
def a_service(data: Path, server: str) -> Iterator[Client]:
    """Start a service that has loaded what it needs, and yield a client of it."""
    with service(data, variables_of(server), workers=2) as address:
        sleep(SETTLED)
        yield Client(address)


if __name__ == "__main__":
    main()
