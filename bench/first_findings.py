"""Measure how soon an idle service shows the first findings of an upload, for each package.

From the answer to the upload until a client that follows the events sees that there are static
findings. Each package and its meshes are new to the service. Run with `python -m
bench.first_findings` from the top folder, as `make bench` does; SUBT_CHECK_CORPUS names the folder
of real packages. Machines differ and are shared: see the load that is printed.
"""

from __future__ import annotations

import os
import statistics
import tempfile
from functools import partial
from pathlib import Path
from time import perf_counter, sleep

from bench.machine import pace, undisturbed
from bench.service import Client, show
from bench.static import ROOT, keep_bytecode, real_packages
from support.service import service, zip_of

LIMIT = 2.0
"""Seconds."""
READY_SECONDS = 3.0
"""Seconds in which a service that has just started gets ready for its first check."""
OF_CORPUS = 5


def packages() -> list[Path]:
    """Return the samples, and some of the corpus where there is one."""
    samples = [path.parent for path in sorted((ROOT / "samples").glob("*/package.xml"))]
    real = [path for path in real_packages() if path not in samples]
    return samples + real[:: max(1, len(real) // OF_CORPUS)][:OF_CORPUS]


def delay(package: Path) -> float:
    """Upload a package to a new service, and return how long its first findings take."""
    with tempfile.TemporaryDirectory() as folder, service(Path(folder) / "data") as address:
        client, archive = Client(address), zip_of([package], Path(folder) / "made.zip")
        sleep(READY_SECONDS)
        id = client.upload(f"{package.name}.zip", archive.read_bytes()).id
        answered = perf_counter()
        for event in client.events(id):
            if event["data"].get("result"):
                return perf_counter() - answered
    raise AssertionError(f"no findings of {package.name}")


def main() -> None:
    """Measure and print everything."""
    keep_bytecode()
    show("load before", os.getloadavg()[0], "")
    show("pace before", pace(), "ms")
    delays = []
    for package in packages():
        delays.append(undisturbed(partial(delay, package)))
        show(package.name, delays[-1], "s")
    show("pace after", pace(), "ms")
    show("median", statistics.median(delays), "s", LIMIT)
    show("slowest", max(delays), "s", LIMIT)


if __name__ == "__main__":
    main()
