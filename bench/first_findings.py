"""How soon an idle service shows the first findings of an upload, package by package.

From the answer to the upload until a client that follows the events sees that there are static
findings. Each package is new to the service, its meshes as well. Run with
`python -m bench.first_findings` from the top folder, as `make bench` does; SUBT_CHECK_CORPUS names
the folder of real packages. Machines differ and are shared: see the load that is printed.
"""

from __future__ import annotations

import os
import statistics
import tempfile
from pathlib import Path
from time import perf_counter

from bench.service import Client, show
from bench.static import ROOT, keep_bytecode, real_packages
from tests.web.service import service, zip_of

LIMIT = 2.0
"""Seconds."""
OF_CORPUS = 5


def packages() -> list[Path]:
    """Return the samples, and some of the corpus where there is one."""
    samples = [path.parent for path in sorted((ROOT / "samples").glob("*/package.xml"))]
    real = [path for path in real_packages() if path not in samples]
    return samples + real[:: max(1, len(real) // OF_CORPUS)][:OF_CORPUS]


def delay(client: Client, name: str, content: bytes) -> float:
    """Upload a package, return how long its first findings take, and wait until it is over."""
    id = client.upload(name, content).id
    answered, seen = perf_counter(), 0.0
    for event in client.events(id):
        if event["data"].get("result") and not seen:
            seen = perf_counter() - answered
    return seen


def main() -> None:
    """Measure and print everything."""
    keep_bytecode()
    show("load before", os.getloadavg()[0], "")
    delays = []
    with tempfile.TemporaryDirectory() as folder, service(Path(folder) / "data") as address:
        for package in packages():
            archive = zip_of([package], Path(folder) / "made.zip")
            delays.append(delay(Client(address), f"{package.name}.zip", archive.read_bytes()))
            show(package.name, delays[-1], "s")
    show("median", statistics.median(delays), "s", LIMIT)
    show("slowest", max(delays), "s", LIMIT)


if __name__ == "__main__":
    main()
