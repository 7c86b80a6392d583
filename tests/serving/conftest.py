"""The service as users start it: `subt-check serve` in a process of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest

SECONDS = 240
"""For what takes two on an idle machine."""


def wait_for(what: Callable[[], object]) -> None:
    """Wait until something holds."""
    ends = time.monotonic() + SECONDS
    while not what():
        assert time.monotonic() < ends
        time.sleep(0.05)


def command_of(process: int) -> str:
    """Return the command line of a process; empty if there is none or it has ended."""
    with suppress(OSError):
        return Path(f"/proc/{process}/cmdline").read_bytes().replace(b"\0", b" ").decode()
    return ""


def children_of(process: int, kind: str) -> list[int]:
    """Return the processes of the service that a process has started, such as its workers."""
    with suppress(OSError):
        text = Path(f"/proc/{process}/task/{process}/children").read_text("ascii")
        return [int(each) for each in text.split() if f"{process} {kind} " in command_of(int(each))]
    return []


@dataclass
class Serving:
    """A service that runs.

    Attributes:
        folder: Holds what it says, and its data.
    """

    process: subprocess.Popen[bytes]
    folder: Path

    @property
    def id(self) -> int:
        return self.process.pid

    @property
    def said(self) -> str:
        return (self.folder / "stdout").read_text("utf-8")

    @property
    def told(self) -> str:
        return (self.folder / "stderr").read_text("utf-8")

    @property
    def url(self) -> str:
        wait_for(lambda: "\n" in self.said or self.process.poll() is not None)
        assert self.process.poll() is None, self.told
        return self.said.split()[-1]

    def workers(self) -> list[int]:
        return children_of(self.id, "worker")

    def web(self) -> list[int]:
        return children_of(self.id, "web")

    def stop(self) -> int:
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(SECONDS)


Serve = Callable[..., Serving]


def environment_of(folder: Path) -> dict[str, str]:
    own = {name: text for name, text in os.environ.items() if not name.startswith("SUBT_CHECK_")}
    return own | {"SUBT_CHECK_DATA": str(folder / "data")}


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Serve]:
    """Start the service at a free port; it ends with the test."""
    started: list[Serving] = []

    def start(
        *options: object, program: Sequence[str] = ("-m", "checker.cli"), **environment: str
    ) -> Serving:
        folder = tmp_path / f"serving-{len(started)}"
        folder.mkdir()
        command = [sys.executable, *program, "serve", "--port", "0"]
        with (folder / "stdout").open("wb") as out, (folder / "stderr").open("wb") as err:
            process = subprocess.Popen(
                [*command, *map(str, options)],
                stdout=out,
                stderr=err,
                cwd=folder,
                env=environment_of(folder) | environment,
                start_new_session=True,
                umask=0,  # the laxest: nothing may depend on it
            )
        started.append(Serving(process, folder))
        return started[-1]

    yield start
    for each in started:
        each.process.kill()
        each.process.wait()
