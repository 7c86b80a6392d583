"""A service as the client sees it: a server on this machine that answers as a test wants."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from checker.report.json_report import to_json
from checker.service.client.connection import Patience
from tests.command.conftest import clean_environment
from tests.report.any_report import many

ID = "A-check_of_22_letters_"
SECRET = "A-secret-of-22_letters"  # noqa: S105
QUICK = Patience(silence=5.0, answer=5.0, trouble=3.0, pause=0.02, longest_pause=0.1)


@dataclass(frozen=True)
class Asked:
    """A request as it came."""

    method: str
    path: str
    headers: dict[str, str]
    body: bytes


Answers = Callable[[Asked], bytes | None]
"""Returns what goes over the wire; None when it has been sent already, or shall not be."""


def answer(status: int, body: object = "", **headers: str) -> bytes:
    """Return an answer; what is no text or bytes is sent as JSON."""
    said = body if isinstance(body, bytes) else body.encode() if isinstance(body, str) else None
    said = json.dumps(body).encode() if said is None else said
    lines = [f"HTTP/1.1 {status} x", f"Content-Length: {len(said)}", "Connection: close"]
    lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
    return "\r\n".join([*lines, "", ""]).encode() + said


@dataclass
class Service:
    """Answers one connection after the other, each with one request."""

    respond: Answers
    asked: list[Asked] = field(default_factory=list)
    early: Callable[[str], bytes] | None = None
    """Answers by the first line, before the body is read, and hangs up."""

    def __post_init__(self) -> None:
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"
        self.connection: socket.socket | None = None
        threading.Thread(target=self._serve, daemon=True).start()

    def close(self) -> None:
        with suppress(OSError):
            self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()

    @property
    def lines(self) -> list[str]:
        return [f"{each.method} {each.path}" for each in self.asked]

    def _serve(self) -> None:
        with suppress(OSError):
            while True:
                connection, _ = self._listening.accept()
                with connection, suppress(OSError, ValueError):
                    self._take(connection)

    def _take(self, connection: socket.socket) -> None:
        connection.settimeout(10)
        with connection.makefile("rb") as file:
            first = file.readline().decode()
            method, path, _ = first.split(" ", 2)
            headers = {}
            while line := file.readline().decode().strip():
                name, _, value = line.partition(": ")
                headers[name.lower()] = value
            if self.early is not None and method == "POST":
                connection.sendall(self.early(first))
                return
            body = file.read(int(headers.get("content-length", "0")))
        self.asked.append(Asked(method, path, headers, body))
        self.connection = connection
        said = self.respond(self.asked[-1])
        if said is not None:
            connection.sendall(said)


StartService = Callable[[Answers], Service]


@pytest.fixture
def start_service() -> Iterator[StartService]:
    """Start services; they end with the test."""
    started: list[Service] = []

    def start(respond: Answers) -> Service:
        started.append(Service(respond))
        return started[-1]

    yield start
    for each in started:
        each.close()


def in_turn(*answers: bytes | Answers) -> Answers:
    """Give one answer after the other, the last one ever after."""
    left = list(answers)

    def respond(asked: Asked) -> bytes | None:
        given = left.pop(0) if len(left) > 1 else left[0]
        return given if isinstance(given, bytes) else given(asked)

    return respond


def checking(*states: dict[str, object], report: str = "", **files: bytes) -> Answers:
    """Take an upload, then stand as the states say, one after the other.

    Args:
        states: What is said of the check.
        report: Its report in JSON; any one by default.
        files: Of the result.
    """
    standing = in_turn(*(answer(200, state) for state in states))
    written = {"report.json": (report or to_json(many(1))).encode()}
    written |= {name.replace("_", "."): content for name, content in files.items()}

    def respond(asked: Asked) -> bytes | None:
        if asked.path.endswith("/cancel"):
            return answer(200, {"stage": "cancelled"})
        if asked.method == "POST":
            return answer(201, {"id": ID, "secret": SECRET, "url": "http://elsewhere.example/x"})
        name = asked.path.removeprefix(f"/api/checks/{ID}").lstrip("/").removeprefix("packages/")
        if not name:
            return standing(asked)
        if name in written:
            return answer(200, written[name])
        return answer(404, {"error": "There is no such file.", "advice": ""})

    return respond


Submit = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def submit(tmp_path: Path) -> Submit:
    """Run `subt-check submit` in the temporary folder; no traceback comes out."""

    def run(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
        done = subprocess.run(
            [sys.executable, "-m", "checker.cli", "submit", *map(str, arguments)],
            capture_output=True,
            check=False,
            cwd=tmp_path,
            env=clean_environment() | environment,
            text=True,
            timeout=60,
        )
        assert "Traceback" not in done.stderr, done.stderr
        assert "internal error" not in done.stderr, done.stderr
        return done

    return run


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A model file to send."""
    path = tmp_path / "robot.sdf"
    path.write_text("<sdf version='1.6'><model name='robot'/></sdf>", "utf-8")
    return path
