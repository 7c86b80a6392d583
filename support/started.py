"""Processes of the service that tests start and end."""

from __future__ import annotations

import contextlib
import re
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

_STOP_SECONDS = 60.0
_SAID = re.compile(r"the service runs at (http://\S+)\n")


@contextlib.contextmanager
def process(
    command: Sequence[str], cwd: Path, environment: Mapping[str, str], log: Path
) -> Iterator[subprocess.Popen[str]]:
    """Start a process; it has to end properly when it is told to."""
    with log.open("w") as said:
        started = subprocess.Popen(
            command, cwd=cwd, env=dict(environment), stdout=subprocess.PIPE, stderr=said, text=True
        )
    try:
        yield started
        assert started.poll() is None, log.read_text()
        started.send_signal(signal.SIGTERM)
        assert started.wait(_STOP_SECONDS) == 0, log.read_text()
    finally:
        started.kill()
        started.wait()
        assert started.stdout is not None
        started.stdout.close()


def address(started: subprocess.Popen[str]) -> str:
    """Return the address of a service, once it prints it."""
    assert started.stdout is not None
    line = started.stdout.readline()
    said = _SAID.fullmatch(line)
    assert said is not None, f"it says {line!r}"
    return said[1]
