"""A database, a store and real worker processes for tests of the engine."""

from __future__ import annotations

import json
import os
import secrets
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic, sleep
from typing import IO, Any

from checker.base.sandbox.task import end_with_parent
from checker.service.jobs.durable.client import DurableJobs, durable_jobs
from checker.service.jobs.port import Event, Order, Receipt, Stage, State
from checker.service.store.store import Store

ROOT = Path(__file__).parent.parent.parent
PATIENCE = 300.0
QUICK = {"beat_seconds": 0.2, "silence_seconds": 600.0, "grace_seconds": 10.0}


@dataclass
class Site:
    folder: Path
    url: str
    jobs: DurableJobs
    running: list[subprocess.Popen[bytes]] = field(default_factory=list)
    stderr: IO[bytes] | None = None
    """Of workers; None for the terminal."""

    @property
    def store(self) -> Store:
        return self.jobs.store

    @property
    def log(self) -> Path:
        return self.folder / "log"

    def worker(self, name: str = "", **options: Any) -> subprocess.Popen[bytes]:
        """Start a worker process; what it says goes to the terminal if a test fails."""
        given = QUICK | {"database_url": self.url, "store": str(self.store.folder)} | options
        given["name"] = name or f"w{secrets.token_hex(4)}"
        process = subprocess.Popen(
            [sys.executable, "-m", "tests.jobs.quick_worker", json.dumps(given), str(self.log)],
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            stderr=self.stderr,
            preexec_fn=end_with_parent,  # noqa: PLW1509 - one call of the system, no lock
        )
        self.running.append(process)
        return process

    def order(self, profile: str = "", name: str = "") -> Order:
        """Return an order that no other test gives."""
        with self.store.incoming() as incoming:
            incoming.write(secrets.token_bytes(16))
            upload = incoming.finish()
        return Order(upload, name or f"{secrets.token_hex(4)}.zip", profile)

    def submit(self, profile: str = "") -> str:
        return self.receipt(profile).id

    def receipt(self, profile: str = "") -> Receipt:
        return self.jobs.submit(self.order(profile))

    def state(self, id: str) -> State:
        state = self.jobs.status(id)
        assert state is not None
        return state

    def until(self, id: str, reached: Callable[[State], bool]) -> State:
        """Wait until a check has come to something."""
        deadline = monotonic() + PATIENCE
        while not reached(state := self.state(id)):
            assert monotonic() < deadline, f"still {state}"
            sleep(0.05)
        return state

    def end(self, id: str) -> State:
        return self.until(id, lambda state: state.stage.is_final)

    def in_hand(self, id: str, stage: Stage) -> State:
        """Wait until a worker has begun a stage."""
        name = self.state(id).order.name
        return self.until(id, lambda _: self.begun()[f"{stage} {name}"] > 0)

    def begun(self) -> Counter[str]:
        """Return how often each stage of each check was begun, by "stage name"."""
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        return Counter(line.rpartition(" ")[0] for line in lines)

    def stages(self, id: str) -> list[tuple[int, str]]:
        return [(event.number, event.stage.value) for event in self.events(id)]

    def events(self, id: str, after: int = 0) -> Sequence[Event]:
        return self.jobs.events({id: after}).get(id, ())

    def close(self) -> None:
        for process in self.running:
            process.kill()
            process.wait()
        self.jobs.checks.engine.dispose()


def site_in(folder: Path, url: str) -> Site:
    return Site(folder, url, durable_jobs(url, Store(folder / "store")))
