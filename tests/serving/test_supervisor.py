"""Processes are kept running, with patience for those that die again and again."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from itertools import pairwise
from pathlib import Path

from checker.service.processes.supervisor import Pace, Process, keep_running, stop_all
from tests.serving.conftest import wait_for

QUICK = Pace(first_wait=0.3, longest_wait=1.0, grace=1.0)
STAMP = "import sys, time; open(sys.argv[1], 'a').write(f'{time.monotonic()}\\n')"
SLEEP = "; time.sleep(600)"
DEAF = "import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); "


def process(code: str, stamps: Path) -> Process:
    return Process("the process", [sys.executable, "-c", code, str(stamps)], os.environ)


def times(stamps: Path) -> list[float]:
    return [float(line) for line in stamps.read_text().split()] if stamps.exists() else []


def test_one_that_dies_waits_longer_each_time(tmp_path: Path) -> None:
    stop, said = threading.Event(), list[str]()
    kept = process(STAMP + "; sys.exit(7)", tmp_path / "stamps")
    keeper = threading.Thread(target=keep_running, args=([kept], stop, QUICK, said.append))
    kept.start()
    keeper.start()
    wait_for(lambda: len(said) >= 5)
    stop.set()
    keeper.join()
    waits = ["0.3", "0.6", "1", "1", "1"]
    assert said[:5] == [f"the process ended with exit code 7; it restarts in {w} s" for w in waits]
    started = times(tmp_path / "stamps")
    pauses = [later - sooner for sooner, later in pairwise(started)]
    assert all(pause >= float(wait) for pause, wait in zip(pauses, waits, strict=False))


def test_one_that_was_told_to_end_is_not_restarted(tmp_path: Path) -> None:
    stop, said = threading.Event(), list[str]()
    kept = process(STAMP, tmp_path / "stamps")
    kept.start()
    threading.Timer(2.0, stop.set).start()
    keep_running([kept], stop, QUICK, said.append)
    assert said == ["the process has ended as it was told, and is not restarted"]
    assert len(times(tmp_path / "stamps")) == 1
    assert stop_all([kept], threading.Event(), QUICK)


def test_one_that_lives_is_left_alone(tmp_path: Path) -> None:
    stop, said = threading.Event(), list[str]()
    kept = process(STAMP + SLEEP, tmp_path / "stamps")
    kept.start()
    wait_for(lambda: times(tmp_path / "stamps"))
    threading.Timer(1.0, stop.set).start()
    keep_running([kept], stop, QUICK, said.append)
    assert len(times(tmp_path / "stamps")) == 1
    assert not said
    assert stop_all([kept], threading.Event(), QUICK)
    assert not kept.is_running


def test_one_that_does_not_hear_is_killed_when_its_time_is_over(tmp_path: Path) -> None:
    kept = process(DEAF + STAMP + SLEEP, tmp_path / "stamps")
    kept.start()
    wait_for(lambda: times(tmp_path / "stamps"))
    started = time.monotonic()
    assert not stop_all([kept], threading.Event(), QUICK)
    assert time.monotonic() - started >= QUICK.grace
    assert kept.exit_code == -signal.SIGKILL


def test_nobody_waits_when_it_shall_be_at_once(tmp_path: Path) -> None:
    kept = process(DEAF + STAMP + SLEEP, tmp_path / "stamps")
    kept.start()
    wait_for(lambda: times(tmp_path / "stamps"))
    at_once = threading.Event()
    at_once.set()
    assert not stop_all([kept], at_once, Pace(grace=600.0))
    assert kept.exit_code == -signal.SIGKILL


def test_what_was_never_started_is_stopped_as_well(tmp_path: Path) -> None:
    assert stop_all([process(STAMP, tmp_path / "stamps")], threading.Event(), QUICK)
    assert not times(tmp_path / "stamps")
