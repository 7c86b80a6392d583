"""A service whose processes can be killed: its data and its database outlive them."""

from __future__ import annotations

import os
import secrets
import signal
import socket
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest

from checker.base.sandbox.task import end_with_parent
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import client_of, open_database
from checker.service.jobs.port import Receipt
from support.postgres import DATABASES, fresh_database
from tests.serving.conftest import (
    SECONDS,
    Serve,
    Serving,
    command_of,
    environment_of,
    serve,  # noqa: F401 (a fixture)
    wait_for,
)
from tests.web.server import form, request_head

ROOT = Path(__file__).parent.parent.parent


@dataclass
class Home:
    """Where a service lives, whatever becomes of its processes.

    Attributes:
        start: Starts `subt-check serve`.
        folder: Holds all that is below.
        database: Its address.
    """

    start: Serve
    folder: Path
    database: str
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)

    @property
    def environment(self) -> dict[str, str]:
        return {
            "SUBT_CHECK_DATA": str(self.folder / "data"),
            "SUBT_CHECK_DATABASE_URL": self.database,
        }

    def serve(self, workers: int = 0) -> Serving:
        return self.start("--workers", workers, **self.environment)

    def worker(self) -> None:
        self.workers.append(
            subprocess.Popen(
                [sys.executable, "-m", "tests.survival.steady_worker", self.folder / "begun"],
                cwd=ROOT,
                env=environment_of(self.folder) | self.environment | {"PYTHONPATH": str(ROOT)},
                preexec_fn=end_with_parent,  # noqa: PLW1509 - one call of the system, no lock
            )
        )

    def kill_workers(self) -> None:
        for each in self.workers:
            each.kill()
            each.wait()

    def begun(self) -> Counter[str]:
        """Return how often each stage was begun, by "stage name"."""
        log = self.folder / "begun"
        return Counter(log.read_text().splitlines() if log.exists() else [])

    def stored(self, kind: str) -> list[Path]:
        """Return the files of uploads, of results, or those that are coming in."""
        return [each for each in (self.folder / "data" / kind).rglob("*") if each.is_file()]

    def keys(self) -> set[str]:
        """Return the checks that the database knows, by their keys."""
        engine = open_database(self.database)
        found = {row.task.key for row in Checks(engine, client_of(engine)).all_rows()}
        engine.dispose()
        return found


@pytest.fixture(params=DATABASES)
def home(request: pytest.FixtureRequest, tmp_path: Path, serve: Serve) -> Iterator[Home]:  # noqa: F811
    if request.param == "sqlite":
        database = f"sqlite:///{tmp_path}/jobs.sqlite"
    else:
        database = fresh_database(request.getfixturevalue("postgres_url"))
    home = Home(serve, tmp_path, database)
    yield home
    home.kill_workers()


def kill(serving: Serving) -> None:
    """Kill all of a service at once; its children end with it."""
    children = serving.web() + serving.workers()
    serving.process.kill()
    serving.process.wait()
    wait_for(lambda: not any(map(command_of, children)))


def kill_web(serving: Serving) -> None:
    """Kill the web server, and wait until another one answers."""
    (old,) = serving.web()
    os.kill(old, signal.SIGKILL)
    wait_for(lambda: serving.web() not in ([], [old]))
    assert httpx.get(f"{serving.url}/healthz", timeout=SECONDS).status_code == 200


def robot() -> bytes:
    """Return a model that nobody has sent before."""
    return f"<sdf><!-- {secrets.token_hex(16)} --></sdf>".encode()


def upload(url: str, name: str = "robot.sdf", content: bytes = b"") -> str:
    """Send a model; return the id of its check."""
    return receipt(url, name, content).id


def receipt(url: str, name: str = "robot.sdf", content: bytes = b"") -> Receipt:
    """Send a model; return what is given for it."""
    files = {"file": (name, content or robot())}
    answer = httpx.post(f"{url}/api/checks", files=files, timeout=SECONDS)
    assert answer.status_code == 201, answer.text
    return Receipt(str(answer.json()["id"]), str(answer.json()["secret"]))


def connected(url: str) -> socket.socket:
    address = urlsplit(url)
    return socket.create_connection((address.hostname, address.port), timeout=SECONDS)


def half_sent(url: str, size: int) -> socket.socket:
    """Return a connection on which half of an upload was sent."""
    body = form("robot.sdf", b"<sdf>".ljust(size))
    connection = connected(url)
    connection.sendall(request_head(len(body)) + body[: size // 2])
    return connection


def wait_for_end(url: str, id: str) -> dict[str, object]:
    """Return what is told of a check when it is over."""
    told: dict[str, object] = {}

    def is_over() -> object:
        told.update(httpx.get(f"{url}/api/checks/{id}", timeout=SECONDS).json())
        return told.get("final")

    wait_for(is_over)
    return told
