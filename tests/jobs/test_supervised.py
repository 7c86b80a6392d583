"""A child with all that it starts is watched, and ended together."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from time import monotonic, sleep

import pytest

from checker.jobs.supervised import Ended, supervised

FAMILY = """
import subprocess, sys, time
again = [sys.executable, "-c", "import time; print('grandchild', flush=True); time.sleep(600)"]
subprocess.Popen(again)
"""


def run(program: str, place: Path, seconds: float = 60.0, cancelled: bool = False) -> Ended:
    """Run a program; cancel it, if so wanted, as soon as it has said something."""
    log = place / "log"

    def unwanted() -> bool:
        return cancelled and b"grandchild" in log.read_bytes()

    return supervised(started(program, place), seconds, unwanted)


def started(program: str, place: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-c", program]
    with (place / "log").open("wb") as said:
        return subprocess.Popen(command, stdout=said, cwd=place, start_new_session=True)


def running_in(place: Path) -> list[int]:
    """Return the processes whose current folder is `place`."""
    found = []
    for each in Path("/proc").glob("[0-9]*"):
        try:
            if (each / "cwd").readlink() == place and "Z" not in (
                each / "stat"
            ).read_text().split():
                found.append(int(each.name))
        except OSError:
            continue
    return found


def none_left_in(place: Path) -> bool:
    deadline = monotonic() + 20
    while running_in(place) and monotonic() < deadline:
        sleep(0.02)
    return not running_in(place)


@pytest.mark.parametrize(
    ("program", "code"),
    [("", 0), ("raise SystemExit(71)", 71), ("import os; os.kill(os.getpid(), 11)", -11)],
)
def test_how_it_ends(program: str, code: int, tmp_path: Path) -> None:
    assert run(program, tmp_path) == Ended(code)


def test_it_takes_too_long(tmp_path: Path) -> None:
    ended = run(FAMILY + "time.sleep(600)", tmp_path, seconds=0.5)
    assert (ended.code, ended.overdue, ended.cancelled) == (-9, True, False)
    assert none_left_in(tmp_path)


def test_it_is_no_longer_wanted(tmp_path: Path) -> None:
    ended = run(FAMILY + "time.sleep(600)", tmp_path, cancelled=True)
    assert (ended.code, ended.overdue, ended.cancelled) == (-9, False, True)
    assert none_left_in(tmp_path)


def test_what_it_leaves_behind_is_ended(tmp_path: Path) -> None:
    assert run(FAMILY, tmp_path) == Ended(0)
    assert none_left_in(tmp_path)


def test_a_question_that_fails_ends_it(tmp_path: Path) -> None:
    def fail() -> bool:
        raise ConnectionError(os.getpid())

    with pytest.raises(ConnectionError):
        supervised(started("import time; time.sleep(600)", tmp_path), 60.0, fail)
    assert none_left_in(tmp_path)
