"""Measures how long a small package waits behind the heavy packages of another sender.

Eight packages with a model of some 10 000 links come from one address, and while they are checked,
a small robot from another. Then two hundred small ones wait, and another sender's first findings
are timed against those on the same service when it was empty. Run with
`python -m bench.fairness` from the top folder, as `make bench` does.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter, sleep

import httpx

from bench.hostile import chain
from bench.service import say, show
from bench.static import ROOT, keep_bytecode
from support.service import service, zip_of

SMALL = ROOT / "samples/subtcheck_buggy_sensor_config_1"
HEAVY = 8
BEHIND = ("--behind-proxy", "127.0.0.1")
LINKS = 9_000
FIRST_LIMIT, REPORT_LIMIT = 10.0, 60.0
"""Seconds until the first findings, and until the report, of the small one."""
WAITING, RATIO_LIMIT = 200, 2.0
"""Small packages of one sender, and how many times as long another sender waits meanwhile."""
_POLL_SECONDS = 0.05
_NO_RATE = {"SUBT_CHECK_UPLOADS_PER_MINUTE": "0"}


def _sent(address: str, sender: str, name: str, content: bytes) -> str:
    """Upload a file from an address, as a proxy reports it, and return the id of its check."""
    headers = {"X-Forwarded-For": sender}
    answer = httpx.post(
        f"{address}/api/checks", files={"file": (name, content)}, headers=headers, timeout=120
    )
    answer.raise_for_status()
    return str(answer.json()["id"])


def _wait(address: str, id: str, *stages: str) -> float:
    """Return the seconds until a check is in one of some stages."""
    begun = perf_counter()
    while True:
        state = httpx.get(f"{address}/api/checks/{id}", timeout=120).json()
        if state["stage"] in stages:
            return perf_counter() - begun
        if state["final"]:
            raise SystemExit(f"a check ends as {state['stage']}: {state['words']}")
        sleep(_POLL_SECONDS)


def main() -> None:
    """Measure and print both figures."""
    keep_bytecode()
    with tempfile.TemporaryDirectory() as folder:
        small = zip_of([SMALL], Path(folder) / "small.zip").read_bytes()
        with service(Path(folder) / "data", _NO_RATE, workers=2, options=BEHIND) as address:
            _beside_many(address)
        with service(Path(folder) / "other", {}, workers=2, options=BEHIND) as address:
            first = _heavy_sent(address)
            say("waits until a heavy one is in hand")
            _wait(address, first, "static", "trial", "done")
            id = _sent(address, "192.0.2.2", "small.zip", small)
            begun = perf_counter()
            _wait(address, id, "trial", "done")
            show("first findings of the small one", perf_counter() - begun, "s", FIRST_LIMIT)
            _wait(address, id, "done")
            show("report of the small one", perf_counter() - begun, "s", REPORT_LIMIT)


def _beside_many(address: str) -> None:
    """Print how much longer first findings take where another sender has many checks waiting."""
    _first_findings(address, 0)  # the first one loads what others find loaded
    alone = median(_first_findings(address, n) for n in range(1, 6))
    for n in range(WAITING):
        _sent(address, "192.0.2.1", "robot.sdf", _robot(1000 + n))
    beside = median(_first_findings(address, n) for n in range(6, 11))
    show("first findings on an empty service", alone, "s")
    show(f"beside {WAITING} that wait, times as long", beside / alone, "", RATIO_LIMIT)


def _first_findings(address: str, number: int) -> float:
    begun = perf_counter()
    _wait(address, _sent(address, "192.0.2.2", "robot.sdf", _robot(number)), "trial", "done")
    return perf_counter() - begun


def _robot(number: int) -> bytes:
    return f"<sdf version='1.9'><model name='m{number}'><link name='base'/></model></sdf>".encode()


def _heavy_sent(address: str) -> str:
    """Send the heavy ones from one address, and return the id of the first."""
    ids = []
    for number in range(HEAVY):
        model = f"<sdf version='1.6'><model name='m{number}'>{chain(LINKS, closed=False)}"
        content = f"{model}</model></sdf>".encode()
        ids.append(_sent(address, "192.0.2.1", "model.sdf", content))
    return ids[0]


if __name__ == "__main__":
    main()
