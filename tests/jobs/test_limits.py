"""What the check of an upload can use."""

from __future__ import annotations

import subprocess
import sys

BEGIN = """
import os, socket, sys
from checker.service.jobs.exchange import StageLimits, limit
limit(StageLimits(seconds=7.5, memory=2_000_000_000, file_bytes=1000, open_files=64))
"""


def run(body: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", BEGIN + body]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_limits_are_set_and_cannot_be_raised() -> None:
    body = """
import resource
for name in ("CPU", "AS", "FSIZE", "NOFILE", "CORE"):
    print(*resource.getrlimit(getattr(resource, f"RLIMIT_{name}")))
resource.setrlimit(resource.RLIMIT_CPU, (9, 9))
"""
    done = run(body)
    assert done.stdout.split("\n")[:-1] == [
        "7 8",
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
    program += "print(*resource.getrlimit(resource.RLIMIT_NOFILE))"
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == "32 32\n"
