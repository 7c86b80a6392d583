"""What a process that reads strangers' files can still do."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

BEGIN = """
import os, socket, sys
from checker.jobs.isolation import StageLimits, isolate, limit
was = os.getuid(), os.getgid()
isolate(PARENT)
limit(StageLimits(seconds=7.5, memory=2_000_000_000, file_bytes=1000, open_files=64))
"""
CAN_LEAVE = "import ctypes; raise SystemExit(ctypes.CDLL(None).unshare(0x50000000))"


def run(body: str, parent: int | None = None) -> subprocess.CompletedProcess[str]:
    program = BEGIN.replace("PARENT", str(os.getpid() if parent is None else parent)) + body
    environment = {**os.environ, "SUBT_CHECK_TOKENS": "hunter2"}
    command = [sys.executable, "-c", program]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=environment)


@pytest.fixture(scope="module")
def _namespaces() -> None:
    if subprocess.run([sys.executable, "-c", CAN_LEAVE], check=False).returncode != 0:
        pytest.skip("this system does not let processes leave the network")


@pytest.mark.usefixtures("_namespaces")
@pytest.mark.parametrize("address", ["127.0.0.1", "192.0.2.1"])
def test_there_is_no_network(address: str) -> None:
    done = run(f"socket.create_connection(({address!r}, 80), timeout=5)")
    assert "OSError: [Errno 101] Network is unreachable" in done.stderr


@pytest.mark.usefixtures("_namespaces")
def test_the_parent_keeps_its_secrets() -> None:
    done = run("open(f'/proc/{os.getppid()}/environ').read()")
    assert "PermissionError" in done.stderr


def test_it_stays_who_it_was() -> None:
    assert run("assert (os.getuid(), os.getgid()) == was").returncode == 0


def test_limits_are_set_and_cannot_be_raised() -> None:
    body = """
import resource
for name in ("CPU", "AS", "FSIZE", "NOFILE", "CORE"):
    print(*resource.getrlimit(getattr(resource, f"RLIMIT_{name}")))
resource.setrlimit(resource.RLIMIT_CPU, (8, 8))
"""
    done = run(body)
    assert done.stdout.split("\n")[:-1] == [
        "7 7",
        "2000000000 2000000000",
        "1000 1000",
        "64 64",
        "0 0",
    ]
    assert "ValueError: not allowed to raise maximum limit" in done.stderr


def test_a_file_that_is_too_large_is_not_written(tmp_path: object) -> None:
    done = run(f"open({str(tmp_path)!r} + '/file', 'wb', buffering=0).write(b'x' * 1001) == 1000")
    assert done.returncode == 0
    done = run(f"open({str(tmp_path)!r} + '/file', 'ab', buffering=0).write(b'x')")
    assert "File too large" in done.stderr


def test_limits_that_are_lower_already_stay() -> None:
    program = "import resource; resource.setrlimit(resource.RLIMIT_NOFILE, (32, 32))\n" + BEGIN
    program = program.replace("PARENT", str(os.getpid()))
    program += "print(*resource.getrlimit(resource.RLIMIT_NOFILE))"
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == "32 32\n"


def test_it_does_not_live_without_its_parent() -> None:
    done = run("print('still here')", parent=1_000_000_000)
    assert "process 1000000000 has ended" in done.stderr
    assert done.stdout == ""
