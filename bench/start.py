"""Measure the time from the start of the service to its first accepted upload.

`subt-check serve` is started with two workers, several times on its own data and once more on
data that is there; a small archive is uploaded as soon as its address is printed. Run with
`python -m bench.start [--postgres]` from the top folder, as `make bench` does. Machines differ and
are shared: see the pace that is printed.
"""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from time import perf_counter

from bench.machine import pace
from bench.service import Client, options_of, server_of, show, variables_of
from bench.static import ROOT, keep_bytecode
from bench.watchers import processor_seconds, web_process
from support.service import service, zip_of

SAMPLE = ROOT / "samples/subtcheck_buggy_sensor_config_1"
CREATED, REPEATS, LIMIT = 201, 5, 3.0
"""Seconds, on two otherwise idle processors."""


def start(data: Path, variables: Mapping[str, str], package: bytes) -> tuple[float, float, float]:
    """Start a service; return when its address is printed, its first upload taken, and its work.

    Returns:
        Seconds, seconds, and seconds of processor time of the web process until then.
    """
    began = perf_counter()
    with service(data, variables, workers=2) as address:
        ready = perf_counter() - began
        upload = Client(address).upload("robot.zip", package)
        taken = perf_counter() - began
        if upload.status != CREATED:
            raise SystemExit(f"the first upload is answered {upload.status}")
        return ready, taken, processor_seconds(web_process())


def main() -> None:
    """Measure and print everything."""
    options = options_of(__doc__).parse_args()
    keep_bytecode()
    show("pace", pace(), "ms")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        server = server_of(options, stack)
        package = zip_of([SAMPLE], folder / "robot.zip").read_bytes()
        times = []
        for number in range(REPEATS):
            url = variables_of(server)
            times.append(start(folder / f"data{number}", url, package))
        ready, taken, work = map(statistics.median, zip(*times, strict=True))
        show("the address is printed", ready, "s")
        show("a first upload is taken", taken, "s", LIMIT)
        show("  slowest", max(each[1] for each in times), "s")
        show("  processor time of the web process", work, "s")
        again = start(folder / f"data{number}", url, package)
        show("the same on data that is there", again[1], "s", LIMIT)


if __name__ == "__main__":
    main()
