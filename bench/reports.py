"""Measure how many reports a second the web process sends, with and without gzip.

A robot is checked by its own service; then eight clients fetch its report again and again,
each over one connection, then its page. Run with `python -m bench.reports [--postgres]` from the
top folder, as `make bench` does. Machines differ and are shared: see the pace that is printed.
"""

from __future__ import annotations

import http.client
import tempfile
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from time import perf_counter
from urllib.parse import urlsplit

from bench.machine import pace
from bench.service import Client, options_of, say, server_of, show, variables_of
from bench.static import ROOT, keep_bytecode
from support.service import service, zip_of

SAMPLE = ROOT / "samples/subtcheck_buggy_sensor_config_1"
CLIENTS, SECONDS = 8, 10.0
GOAL = 300.0
"""Compressed reports a second."""
GZIP = {"Accept-Encoding": "gzip", "Accept": "text/html"}


def fetched(address: str, path: str, headers: Mapping[str, str], ends: float) -> tuple[int, int]:
    """Fetch again and again; return how often, and the bytes of one."""
    connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=60)
    times = size = 0
    while perf_counter() < ends:
        connection.request("GET", path, headers=dict(headers))
        answer = connection.getresponse()
        size = len(answer.read())
        if answer.status != http.client.OK:
            raise SystemExit(f"{path} answers {answer.status}")
        times += 1
    connection.close()
    return times, size


def measure(address: str, path: str, headers: Mapping[str, str]) -> float:
    """Print and return how many answers a second come."""
    began = perf_counter()
    with ThreadPoolExecutor(CLIENTS) as threads:
        clients = [
            threads.submit(fetched, address, path, headers, began + SECONDS) for _ in range(CLIENTS)
        ]
        done = [client.result() for client in clients]
    rate = sum(times for times, _ in done) / (perf_counter() - began)
    name = path.rpartition("/")[2] if "report" in path else "page of a check"
    how = "compressed" if headers else "plain"
    show(f"{name}, {how}, {done[0][1] / 1e3:.0f} kB", rate, "answers/s")
    return rate


def main() -> None:
    """Measure and print everything."""
    options = options_of(__doc__).parse_args()
    keep_bytecode()
    show("pace", pace(), "ms")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        server = server_of(options, stack)
        package = zip_of([SAMPLE], folder / "robot.zip").read_bytes()
        address = stack.enter_context(service(folder / "data", variables_of(server)))
        client = Client(address)
        id = client.upload("robot.zip", package).id
        say("waits for a report")
        client.ends([id])
        for name in ("report.html", "report.json"):
            measure(address, f"/api/checks/{id}/{name}", {})
            rate = measure(address, f"/api/checks/{id}/{name}", GZIP)
            if name == "report.html":
                print(f"  at least {GOAL:g} a second: {'yes' if rate >= GOAL else 'NO'}")
        for headers in ({}, GZIP):
            measure(address, f"/checks/{id}", headers)


if __name__ == "__main__":
    main()
