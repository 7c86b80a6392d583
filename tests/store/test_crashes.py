"""Processes killed in the middle: what they were at is whole or not there, and swept away."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from time import sleep, time

import pytest
from blake3 import blake3

from checker.service.store.store import Store

UPLOADS = """
import os, sys
from pathlib import Path
from checker.service.store.store import Store
store = Store(Path(sys.argv[1]))
print(flush=True)
while True:
    with store.incoming() as incoming:
        for _ in range(20):
            incoming.write(os.urandom(5_000))
        incoming.finish()
"""
RESULTS = """
import secrets, sys
from pathlib import Path
from checker.service.store.store import Store
store = Store(Path(sys.argv[1]))
print(flush=True)
while True:
    with store.workplace() as place:
        for name in ("report.json", "a/report.html", "b/report.html"):
            (place / "made" / name).parent.mkdir(parents=True, exist_ok=True)
            (place / "made" / name).write_text("whole")
        store.keep(secrets.token_hex(32), place / "made")
"""
HALF = """
import sys
from pathlib import Path
from checker.service.store.store import Store
with Store(Path(sys.argv[1])).incoming() as incoming:
    incoming.write(b"half")
    print(flush=True)
    sys.stdin.read()
    incoming.finish()
"""


def start(program: str, store: Store) -> subprocess.Popen[bytes]:
    """Run a program until it says that it has begun."""
    process = subprocess.Popen(
        [sys.executable, "-c", program, str(store.folder)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"\n"
    return process


def kill(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.communicate()


def in_progress(store: Store) -> list[Path]:
    return list((store.folder / "incoming").glob("*"))  # which may not be there yet


@pytest.mark.parametrize("milliseconds", [1, 7, 20, 45, 80])
def test_uploads_of_a_killed_process(milliseconds: int, tmp_path: Path) -> None:
    store = Store(tmp_path)
    process = start(UPLOADS, store)
    sleep(milliseconds / 1000)
    kill(process)
    for path in (tmp_path / "uploads").glob("*/*"):
        assert blake3(path.read_bytes()).hexdigest() == path.name
    store.sweep()
    assert not in_progress(store)


@pytest.mark.parametrize("milliseconds", [1, 7, 20, 45, 80])
def test_results_of_a_killed_process(milliseconds: int, tmp_path: Path) -> None:
    store = Store(tmp_path)
    process = start(RESULTS, store)
    sleep(milliseconds / 1000)
    kill(process)
    for path in (tmp_path / "results").glob("*/*"):
        assert store.names(path.name) == ("a/report.html", "b/report.html", "report.json")
        assert all((path / name).read_text() == "whole" for name in store.names(path.name))
    store.sweep()
    assert not in_progress(store)


def test_the_living_are_not_swept_and_the_dead_are(tmp_path: Path) -> None:
    store = Store(tmp_path)
    living, dead = start(HALF, store), start(HALF, store)
    kill(dead)
    assert len(in_progress(store)) == 2
    store.sweep()
    assert len(in_progress(store)) == 1
    living.communicate(b"")
    assert living.returncode == 0
    assert store.upload(blake3(b"half").hexdigest()) is not None
    assert not in_progress(store)


def test_our_own_work_is_not_swept(tmp_path: Path) -> None:
    store = Store(tmp_path)
    with store.workplace() as place, store.incoming() as incoming:
        (place / "file").touch()
        store.sweep()
        assert (place / "file").exists()
        assert incoming.path.exists()
    assert not in_progress(store)


def test_what_is_nobodys_work_goes_after_a_moment(tmp_path: Path) -> None:
    store = Store(tmp_path)
    with store.workplace() as place:
        home = place.parent
        for name in ("tmpabc", "tmpnew"):
            (home / name).write_bytes(b"a copy of an upload")
        (home / "0123" / "inner").mkdir(parents=True)
        for name in ("tmpabc", "0123", place.name):
            os.utime(home / name, (time() - 60,) * 2)
        store.sweep()
        assert {each.name for each in home.iterdir()} == {
            "tmpnew",
            place.name,
            f"{place.name}.lock",
        }
