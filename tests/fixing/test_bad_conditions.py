"""Folders that cannot be written to, disks that are full, a death amid writing: no half file."""

from __future__ import annotations

import os
import shutil
import signal
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.cli import main
from checker.cli.check.fix import fix_paths, write_files
from checker.finding import Safety
from checker.fix.rounds import Fixed
from checker.package.inputs import open_input
from tests.conftest import SAMPLES

BROKEN = "broken_rover_sensor_config_1"
NOBODY = 65534
KILL_AT = """
import os, signal, sys
from pathlib import Path
from checker.cli import main
count, moved = int(sys.argv[1]), Path.replace

def replace(self, target):
    global count
    if count == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    count -= 1
    return moved(self, target)

Path.replace = replace
main(["--fix", "--no-trial", "--no-cache", "--select", "PKG,SEN,SDF,GEO", sys.argv[2]])
"""


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def wanted(package: Path) -> Fixed:
    (each,) = fix_paths([package], {"select": ("PKG", "SEN", "SDF")}, [Safety.SAFE], write=False)
    return each.fixed


def written(package: Path, fixed: Fixed) -> None:
    with open_input(package) as opened:
        write_files(opened.packages[0], fixed.files)


def said_as_nobody(package: Path, fixed: Fixed) -> str:
    """Return what goes wrong when another user writes; a child of this process becomes them."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        said = "nothing went wrong"
        try:
            if os.geteuid() == 0:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            written(package, fixed)
        except BaseException as error:  # noqa: BLE001 - the child must end here
            said = f"{type(error).__name__}: {error}"
        os.write(writing, said.encode())
        os._exit(0)
    os.close(writing)
    os.waitpid(child, 0)
    with os.fdopen(reading, "rb") as stream:
        return stream.read().decode()


def test_a_folder_that_is_read_only(open_folder: Path) -> None:
    package = Path(shutil.copytree(SAMPLES / BROKEN, open_folder / BROKEN))
    fixed = wanted(package)
    for path in (package, *package.rglob("*")):
        path.chmod(0o555 if path.is_dir() else 0o444)
    before = contents(package)
    said = said_as_nobody(package, fixed)
    for path in (package, *package.rglob("*")):
        path.chmod(path.stat().st_mode | stat.S_IWUSR)
    assert said.startswith("NotWritten: ")
    assert "Permission denied; no file is half written" in said
    assert contents(package) == before


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of its own that holds the package and hardly more."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=2m,nr_inodes=1000", "tmpfs", str(folder)]
    mounted = shutil.which("mount") and subprocess.run(mount, capture_output=True, check=False)
    if not mounted or mounted.returncode:
        pytest.skip("this user may not mount a disk")
    yield folder
    subprocess.run(["umount", str(folder)], check=True)


@pytest.mark.root
def test_a_disk_that_is_full(small_disk: Path) -> None:
    package = Path(shutil.copytree(SAMPLES / BROKEN, small_disk / BROKEN))
    fixed = wanted(package)
    before = contents(package)
    filler = small_disk / "filler"
    with filler.open("wb", buffering=0) as stream, suppress(OSError):
        while True:
            stream.write(bytes(4096))
    with pytest.raises(CheckerError, match="No space left on device; no file is half written"):
        written(package, fixed)
    assert contents(package) == before
    filler.unlink()
    written(package, fixed)
    assert contents(package) != before


@pytest.mark.parametrize("count", [0, 1, 2])
def test_killed_between_two_files(tmp_path: Path, count: int) -> None:
    package = Path(shutil.copytree(SAMPLES / BROKEN, tmp_path / BROKEN))
    before = contents(package)
    command = [sys.executable, "-c", KILL_AT, str(count), str(package)]
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == -signal.SIGKILL
    after = contents(package)
    whole = Path(shutil.copytree(SAMPLES / BROKEN, tmp_path / "whole" / BROKEN))
    chosen = ["--fix", "--no-trial", "--no-cache", "--select", "PKG,SEN,SDF,GEO"]
    main([*chosen, str(whole)])
    expected = contents(whole)
    assert sum(after[path] != content for path, content in before.items()) == count
    for path in before:
        assert after[path] in (before[path], expected[path])
    assert any(path.endswith(".subt-check") for path in after)
    main([*chosen, str(package)])
    assert contents(package) == expected
