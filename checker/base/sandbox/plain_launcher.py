"""Starts processes where the system has no forks: each is a new interpreter, without a sandbox.

It has the limits of its task (`checker.base.sandbox.task.hold_to`) and none of the layers.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import BinaryIO

from msgspec import to_builtins

from checker.base.errors import DEBUG
from checker.base.sandbox.launcher import Order, environment


class PlainLauncher:
    """Starts processes by themselves."""

    def start(self, order: Order, request: BinaryIO, answer: BinaryIO, *_: int) -> PlainProcess:
        """Return a process that starts with its request; see `Launcher.start`."""
        return PlainProcess(order, request, answer)


class PlainProcess:
    """A process, as `checker.base.sandbox.launcher.Started` is one."""

    def __init__(self, order: Order, request: BinaryIO, answer: BinaryIO) -> None:
        """Start nothing yet: a request that is complete can be its standard input."""
        self._order, self._request, self._answer = order, request, answer
        self._process: subprocess.Popen[bytes] | None = None

    def begin(self, _message: bytes) -> None:
        """Start it."""
        module = f"{__package__}.plain_process"
        self._process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
            [sys.executable, "-P", "-m", module, json.dumps(to_builtins(self._order))],
            stdin=self._request,
            stdout=self._answer,
            stderr=None if os.environ.get(DEBUG) else subprocess.DEVNULL,
            env=environment(""),
        )

    def wait(self, seconds: float) -> bytes | None:
        """Return its exit code in digits; None if it still runs after so many seconds."""
        if self._process is None:
            return None
        try:
            return str(self._process.wait(max(0.0, seconds))).encode()
        except subprocess.TimeoutExpired:
            return None

    def kill(self) -> None:
        """End it, whatever it does."""
        if self._process is not None:
            self._process.kill()

    def close(self) -> None:
        """Let go of it once it has ended."""
