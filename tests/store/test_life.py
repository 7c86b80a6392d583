"""A process that has died is known by its lock, and one that lives is never taken for dead."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from checker.service.store.locks import forget, living, the_dead

LIVES = """
import sys, time
from pathlib import Path
from checker.service.store.locks import living
with living(Path(sys.argv[1]), sys.argv[2]):
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
    assert the_dead(folder) == set()
    with process(folder, "one") as one, process(folder, "other") as other:
        assert the_dead(folder) == set()
        one.kill()
        one.wait()
        assert the_dead(folder) == {"one"}
        with living(folder, "one"):
            assert the_dead(folder) == set()
        other.kill()
    assert the_dead(folder) == {"other"}
    forget(folder, "other")
    forget(folder, "other")
    assert the_dead(folder) == set()
    assert list(folder.iterdir()) == []


def test_two_of_the_same_name_are_let_be(tmp_path: Path) -> None:
    with living(tmp_path, "one"), living(tmp_path, "one"):
        assert the_dead(tmp_path) == set()
    assert the_dead(tmp_path) == set()


def test_one_that_ends_leaves_nothing(tmp_path: Path) -> None:
    with living(tmp_path, "one"):
        assert [path.name for path in tmp_path.iterdir()] == ["one"]
    assert list(tmp_path.iterdir()) == []
