"""The process that measures, one for all tests of a worker."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SECONDS = 5.0
"""Processor time that reading a hostile text may take; the slowest takes 0.9, one without a limit
20."""
MEGABYTES = 200.0

Measure = Callable[[str, str], str]


@pytest.fixture(scope="session")
def bounded() -> Iterator[Measure]:
    """Return what reads a hostile text, looks that it takes little, and returns what was said."""
    with subprocess.Popen(
        [sys.executable, "-m", "tests.evaluated.measuring"],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        asked, answered = process.stdin, process.stdout
        assert asked is not None
        assert answered is not None

        def measure(group: str, name: str) -> str:
            asked.write(json.dumps([group, name]) + "\n")
            asked.flush()
            seconds, megabytes, said = json.loads(answered.readline())
            assert seconds < SECONDS, said
            assert megabytes < MEGABYTES, said
            return str(said)

        yield measure
        asked.close()
