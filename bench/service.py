"""Code that the benches of the service share: packages to upload, a client, memory figures."""

from __future__ import annotations

import argparse
import http.client
import json
import os
import random
import re
import sys
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter, sleep
from typing import Any
from urllib.parse import urlsplit

from checker.base.sandbox.usage import descendant_ids
from support.postgres import fresh_database, started

_BORDER = "subt-check-bench"
_PATIENCE = 120.0
"""Seconds that an answer may take before the bench gives up."""
_POLL_SECONDS = 1.0


@dataclass(frozen=True)
class Upload:
    """Result of an upload.

    Attributes:
        status: The status of the answer.
        id: The id of the check; empty if it was refused.
        seconds: Seconds from the first byte sent, the connection with it, to the last one of the
            answer.
    """

    status: int
    id: str
    seconds: float


@dataclass(frozen=True)
class Client:
    """Client of a service, as any program: a connection for each request.

    Attributes:
        address: The address, such as `http://127.0.0.1:8000`.
    """

    address: str

    def upload(self, name: str, content: bytes) -> Upload:
        """Send a package."""
        head = (
            f'--{_BORDER}\r\nContent-Disposition: form-data; name="file"; filename="{name}"\r\n'
            "Content-Type: application/octet-stream\r\n\r\n"
        )
        body = (head.encode(), content, f"\r\n--{_BORDER}--\r\n".encode())
        begun = perf_counter()
        status, said = self._ask("POST", "/api/checks", body)
        return Upload(status, json.loads(said).get("id", ""), perf_counter() - begun)

    def state(self, id: str) -> Mapping[str, Any]:
        """Return the state of a check."""
        return self._json(f"/api/checks/{id}")

    def report(self, id: str) -> Mapping[str, Any]:
        """Return the JSON report of a check."""
        return self._json(f"/api/checks/{id}/report.json")

    def events(self, id: str) -> Iterator[Mapping[str, Any]]:
        """Yield the events of a check until its end."""
        with closing(self._connection()) as connection:
            connection.request("GET", f"/api/checks/{id}/events")
            for line in connection.getresponse():
                if line.startswith(b"data: "):
                    yield json.loads(line.removeprefix(b"data: "))

    def ends(self, ids: Iterable[str]) -> dict[str, Mapping[str, Any]]:
        """Wait until all checks are over, and return their states."""
        over: dict[str, Mapping[str, Any]] = {}
        for id in ids:
            while not (state := self.state(id))["final"]:
                sleep(_POLL_SECONDS)
            over[id] = state
        return over

    def _json(self, path: str) -> Mapping[str, Any]:
        status, said = self._ask("GET", path)
        if status != http.client.OK:
            raise SystemExit(f"{path} answers {status}: {said[:300]!r}")
        answer: Mapping[str, Any] = json.loads(said)
        return answer

    def _ask(self, method: str, path: str, body: Sequence[bytes] = ()) -> tuple[int, bytes]:
        headers = {"Content-Length": str(sum(map(len, body)))}
        if body:
            headers["Content-Type"] = f"multipart/form-data; boundary={_BORDER}"
        with closing(self._connection()) as connection:
            connection.request(method, path, body, headers)
            answer = connection.getresponse()
            return answer.status, answer.read()

    def _connection(self) -> http.client.HTTPConnection:
        return http.client.HTTPConnection(urlsplit(self.address).netloc, timeout=_PATIENCE)


def options_of(about: str | None) -> argparse.ArgumentParser:
    """Return the options of a bench, among which is the kind of the database."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--postgres", action="store_true", help="instead of SQLite")
    return parser


def server_of(options: argparse.Namespace, stack: ExitStack) -> str:
    """Return the address of PostgreSQL, which is started if requested; else empty."""
    return stack.enter_context(started()) if options.postgres else ""


def variables_of(server: str) -> dict[str, str]:
    """Return the variables of a service with a new database: of a server, or SQLite's file."""
    return {"SUBT_CHECK_DATABASE_URL": fresh_database(server)} if server else {}


def noise(number: int, megabytes: float) -> bytes:
    """Return a picture (PNG) that cannot be compressed, another one for each number."""
    import io

    from PIL import Image

    side = int((megabytes * 1e6 / 3) ** 0.5)
    noise = random.Random(number).randbytes(3 * side**2)
    picture = Image.frombytes("RGB", (side, side), noise)
    made = io.BytesIO()
    picture.save(made, "PNG", compress_level=1)
    return made.getvalue()


def other_robot(model: str, number: int) -> str:
    """Return a model file whose robot weighs slightly more, so that no earlier trial is used."""

    def heavier(found: re.Match[str]) -> str:
        return f"{found[1]}{float(found[2]) * (1 + number * 1e-7)!r}"

    said = re.sub(r"(<mass>\s*)(\d+\.?\d*)", heavier, model, count=1)
    return said.replace("</sdf>", f"<!-- {number} --></sdf>")


@dataclass
class Memory:
    """Memory of processes, MB.

    Attributes:
        all: The most that all processes below this one had at once; pages that they share count
            for each of them.
        web: The most that the web process ever had.
    """

    all: float = 0.0
    web: float = 0.0
    _over: threading.Event = field(default_factory=threading.Event)

    def look(self) -> None:
        """Look at all processes again and again."""
        while not self._over.wait(0.5):
            pids = descendant_ids(os.getpid())
            self.all = max(self.all, sum(_status(pid, "VmRSS") for pid in pids))
            web = (_status(pid, "VmHWM") for pid in of_service(pids, "web"))
            self.web = max(self.web, *web, 0.0)

    def stop(self) -> None:
        """Look no more."""
        self._over.set()


@contextmanager
def watched() -> Iterator[Memory]:
    """Watch the memory of all processes below this one."""
    memory = Memory()
    looking = threading.Thread(target=memory.look)
    looking.start()
    try:
        yield memory
    finally:
        memory.stop()
        looking.join()


def command_of(pid: int) -> bytes:
    """Return the command of a process, a zero behind each word; empty if it has ended."""
    return _read(pid, "cmdline")


def of_service(pids: Iterable[int], kind: str) -> list[int]:
    """Return those processes that are the `web` process of a service, or a `worker` of it."""
    return [pid for pid in pids if f"\0{kind}\0".encode() in command_of(pid)]


def _status(pid: int, name: str) -> float:
    said = re.search(rf"{name}:\s+(\d+)".encode(), _read(pid, "status"))
    return int(said[1]) / 1024 if said else 0.0


def _read(pid: int, name: str) -> bytes:
    try:
        return Path(f"/proc/{pid}/{name}").read_bytes()
    except OSError:  # it has ended
        return b""


def say(words: str) -> None:
    """Print the progress of the bench."""
    print(words, file=sys.stderr, flush=True)


def show(name: str, value: float, unit: str, limit: float | None = None) -> None:
    """Print a figure, with the limit that it should stay below."""
    judged = "yes" if limit is None or value <= limit else "NO"
    print(f"{name:<44} {value:8.2f} {unit}" + (f"  (≤ {limit:g}: {judged})" if limit else ""))
