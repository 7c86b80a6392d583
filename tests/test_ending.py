"""Requests to end are heard wherever the program is, each in its turn."""

from __future__ import annotations

import subprocess
import sys

import pytest

BEGIN = """
import signal, threading
from checker.base.signals import on_requests_to_end
first, second = threading.Event(), threading.Event()
on_requests_to_end([signal.SIGTERM, signal.SIGINT], first.set, second.set)
"""
WITHIN = """
with first._cond:
    signal.raise_signal(signal.SIGTERM)
assert first.wait(20)
"""
IN_TURN = """
signal.raise_signal(signal.SIGINT)
assert first.wait(20)
assert not second.is_set()
signal.raise_signal(signal.SIGTERM)
assert second.wait(20)
signal.raise_signal(signal.SIGTERM)
"""
AT_ONCE = """
for _ in range(2):
    signal.raise_signal(signal.SIGTERM)
assert first.wait(20)
assert second.wait(20)
"""


@pytest.mark.parametrize("then", [WITHIN, IN_TURN, AT_ONCE], ids=["within", "in turn", "at once"])
def test_a_request_is_heard(then: str) -> None:
    """`within`: where the main thread holds the lock of the event itself, as `wait` does."""
    program = [sys.executable, "-c", BEGIN + then]
    done = subprocess.run(program, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")
