"""Services that are started again whenever they have been killed, and what kills them."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic, sleep

import httpx

from bench.service import command_of, of_service
from bench.static import ROOT
from checker.base.sandbox.usage import descendant_ids
from support.postgres import free_port


@dataclass
class Group:
    """A service that is started again whenever it has been killed.

    Attributes:
        number: The number of the port, also in the name of its log.
        folder: Contains the data, and the log.
        bucket: Variables that lead to one of S3, so that it has its own data; empty: in a folder
            with other services.
        database: Its address; empty for SQLite with the data.
        workers: The number of workers that it starts.
    """

    number: int
    folder: Path
    database: str
    workers: int
    bucket: Mapping[str, str] = field(default_factory=dict)
    port: int = 0
    _process: subprocess.Popen[bytes] | None = None

    @property
    def address(self) -> str:
        """Return where it answers."""
        return f"http://127.0.0.1:{self.port}"

    @property
    def data(self) -> Path:
        """Return its data folder."""
        return self.folder / (f"data-{self.number}" if self.bucket else "data")

    @property
    def id(self) -> int:
        """Return the id of its first process."""
        return self._process.pid if self._process else 0

    def start(self) -> None:
        """Start it, and wait until it answers.

        Raises:
            SystemExit: It does not.
        """
        self.port = self.port or free_port()
        own = {"SUBT_CHECK_DATA": str(self.data), "SUBT_CHECK_UPLOADS_PER_MINUTE": "0"}
        own |= {"SUBT_CHECK_DATABASE_URL": self.database} if self.database else {}
        command = [sys.executable, "-m", "checker.cli", "serve", "--port", str(self.port)]
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                [*command, "--workers", str(self.workers)],
                env=os.environ | own | self.bucket,
                cwd=ROOT,
                stdout=subprocess.DEVNULL,
                stderr=log,
                start_new_session=True,
            )
        self._wait()

    def kill(self) -> None:
        """Kill all of it at once, and start it again."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
        self.start()

    def stop(self) -> int:
        """Stop it in good order, and return its exit code."""
        assert self._process is not None
        self._process.send_signal(signal.SIGTERM)
        return self._process.wait(120)

    def look(self) -> None:
        """Raise if it has ended by itself, so that no caller waits for it.

        Raises:
            SystemExit: It has.
        """
        code = self._process.poll() if self._process else None
        if code not in (None, -signal.SIGKILL):
            said = self._log.read_text("utf-8", "replace").splitlines()
            raise SystemExit(f"{self.address} has ended with {code}: {' '.join(said[-1:])}")

    @property
    def _log(self) -> Path:
        return self.folder / f"log-{self.number}"

    def _wait(self) -> None:
        ends = monotonic() + 60.0
        while monotonic() < ends:
            self.look()
            with suppress(httpx.TransportError):
                httpx.get(f"{self.address}/healthz", timeout=5)
                return
            sleep(0.1)
        raise SystemExit(f"{self.address} does not answer")


# What is killed.


def of_group(group: Group, kind: str) -> list[int]:
    """Return the `web` process of a service, or each `worker` of it."""
    return of_service(descendant_ids(group.id), kind)


def of_launchers(pids: Sequence[int]) -> list[int]:
    """Return the processes below others that read untrusted files, with their launchers."""
    found = [inner for pid in pids for inner in descendant_ids(pid)]
    return [pid for pid in found if b"launcher_process" in command_of(pid)]


def _kill_worker(group: Group, dice: random.Random) -> bool:
    return _kill_one(of_group(group, "worker"), dice)


def _kill_web(group: Group, dice: random.Random) -> bool:
    return _kill_one(of_group(group, "web"), dice)


def _kill_child(group: Group, dice: random.Random) -> bool:
    """Kill a process of a check: its launcher, the one that checks, or one that reads or drives."""
    return _kill_one(of_launchers(of_group(group, "worker")), dice)


def _kill_reader(group: Group, dice: random.Random) -> bool:
    return _kill_one(of_launchers(of_group(group, "web")), dice)


def _kill_all(group: Group, _dice: random.Random) -> bool:
    group.kill()
    return True


def _kill_one(pids: Sequence[int], dice: random.Random) -> bool:
    if not pids:
        return False
    with suppress(ProcessLookupError):
        os.kill(dice.choice(pids), signal.SIGKILL)
        return True
    return False


KINDS: Mapping[str, Callable[[Group, random.Random], bool]] = {
    "worker": _kill_worker,
    "process of a check": _kill_child,
    "web server": _kill_web,
    "reader of archives": _kill_reader,
    "everything": _kill_all,
}


@dataclass
class Killer:
    """Kills processes of services until it is stopped.

    Attributes:
        kills: The required number of kills.
        pause: Seconds between two of them, on average.
        done: The number of kills of each kind.
    """

    groups: Sequence[Group]
    kills: int
    pause: float
    seed: int = 7
    done: Counter[str] = field(default_factory=Counter)

    def run(self, is_over: Callable[[], bool]) -> None:
        """Kill one after the other, each kind in its turn."""
        dice, kinds = random.Random(self.seed), list(KINDS)
        turn = 0
        while self.done.total() < self.kills and not is_over():
            kind = kinds[turn % len(kinds)]
            turn += 1
            if KINDS[kind](dice.choice(self.groups), dice):
                self.done[kind] += 1
                sleep(dice.uniform(0.5, 1.5) * self.pause)
            else:
                sleep(0.05)
