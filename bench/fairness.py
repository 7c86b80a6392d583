"""Somebody sends heavy packages, then somebody else a small one: how long that one waits.

Eight packages with a model of some 10 000 links come from one address, and while they are checked,
a small robot from another. Run with `python -m bench.fairness` from the top folder, as `make bench`
does.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from time import perf_counter, sleep

import httpx

from bench.hostile import chain
from bench.service import say, show
from bench.static import ROOT, keep_bytecode
from tests.web.service import service, zip_of

SMALL = ROOT / "samples/subtcheck_buggy_sensor_config_1"
HEAVY = 8
BEHIND = ("--behind-proxy", "127.0.0.1")
LINKS = 9_000
FIRST_LIMIT, REPORT_LIMIT = 10.0, 60.0
"""Seconds until the first findings, and until the report, of the small one."""
_POLL_SECONDS = 0.1


def _sent(address: str, sender: str, name: str, content: bytes) -> str:
    """Upload a file from an address, as a proxy tells it, and return the id of its check."""
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
        with service(Path(folder) / "data", {}, workers=2, options=BEHIND) as address:
            first = _heavy_sent(address)
            say("waits until a heavy one is in hand")
            _wait(address, first, "static", "trial", "done")
            id = _sent(address, "192.0.2.2", "small.zip", small)
            begun = perf_counter()
            _wait(address, id, "trial", "done")
            show("first findings of the small one", perf_counter() - begun, "s", FIRST_LIMIT)
            _wait(address, id, "done")
            show("report of the small one", perf_counter() - begun, "s", REPORT_LIMIT)


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
