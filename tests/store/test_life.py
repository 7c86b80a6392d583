"""A process that has died is known by its lock, and one that lives is never taken for dead."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from checker.service.store.locks import dead_processes, forget, hold_lock

LIVES = """
import sys, time
from pathlib import Path
from checker.service.store.locks import hold_lock
with hold_lock(Path(sys.argv[1]), sys.argv[2]):
    print("lives", flush=True)
    time.sleep(600)
"""


def process(folder: Path, name: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-c", LIVES, str(folder), name]
    started = subprocess.Popen(command, stdout=subprocess.PIPE)
    assert started.stdout is not None
    assert started.stdout.readline() == b"lives\n"
    return started


def test_one_that_is_killed_is_dead_until_it_is_back(tmp_path: Path) -> None:
    folder = tmp_path / "workers"
    assert dead_processes(folder) == set()
    with process(folder, "one") as one, process(folder, "other") as other:
        assert dead_processes(folder) == set()
        one.kill()
        one.wait()
        assert dead_processes(folder) == {"one"}
        with hold_lock(folder, "one"):
            assert dead_processes(folder) == set()
        other.kill()
    assert dead_processes(folder) == {"other"}
    forget(folder, "other")
    forget(folder, "other")
    assert dead_processes(folder) == set()
    assert list(folder.iterdir()) == []


def test_two_of_the_same_name_are_let_be(tmp_path: Path) -> None:
    with hold_lock(tmp_path, "one"), hold_lock(tmp_path, "one"):
        assert dead_processes(tmp_path) == set()
    assert dead_processes(tmp_path) == set()


def test_one_that_ends_leaves_nothing(tmp_path: Path) -> None:
    with hold_lock(tmp_path, "one"):
        assert [path.name for path in tmp_path.iterdir()] == ["one"]
    assert list(tmp_path.iterdir()) == []
