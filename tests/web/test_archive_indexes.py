"""Indexes of archives are read by processes that may die, or be taken over."""

from __future__ import annotations

import os
import signal
import sys
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from checker.base.errors import UnreadableInput
from checker.service.web.uploads import archive_indexes
from checker.service.web.uploads.archive_indexes import ArchiveIndexes
from support.disk import full, small_disk
from tests.jobs.launched import is_alive, launchers, tasks
from tests.web.server import eventually

needs_proc = pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="the system has no /proc")


def archive(folder: Path, *names: str) -> Path:
    with zipfile.ZipFile(folder / "made.zip", "w") as made:
        for name in names:
            made.writestr(name, "<x/>")
    return folder / "made.zip"


def test_what_an_index_holds(tmp_path: Path) -> None:
    looked = ArchiveIndexes()
    looked.check(archive(tmp_path, "p/package.xml"), "a.zip")
    with pytest.raises(UnreadableInput, match="leads out of the archive"):
        looked.check(archive(tmp_path, "../p/package.xml"), "a.zip")
    (tmp_path / "no.tar.gz").write_bytes(b"no archive")
    with pytest.raises(UnreadableInput, match=r"not a tar\.gz archive"):
        looked.check(tmp_path / "no.tar.gz", "no.tar.gz")
    with pytest.raises(OSError, match="No such file"):
        looked.check(tmp_path / "none.zip", "none.zip")


def test_many_at_once(tmp_path: Path) -> None:
    looked, path = ArchiveIndexes(), archive(tmp_path, "p/package.xml")
    with ThreadPoolExecutor(8) as threads:
        assert list(threads.map(lambda _: looked.check(path, "a.zip"), range(100))) == [None] * 100


def read_by(module: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have a hostile module read the indexes."""
    (folder / "hostile_reader.py").write_text(module)
    monkeypatch.setenv("PYTHONPATH", str(folder))
    monkeypatch.setattr(archive_indexes, "_MODULE", "hostile_reader")


@needs_proc
def test_one_that_dies_is_replaced(tmp_path: Path) -> None:
    before = {*tasks(), *launchers()}
    looked, path = ArchiveIndexes(), archive(tmp_path, "p/package.xml")
    looked.start()
    assert eventually(lambda: len({*tasks()} - before) == 4)  # each starts a moment later
    looked.check(path, "a.zip")
    assert eventually(lambda: len({*tasks()} - before) == 3)  # and ends a moment later
    waiting = {*tasks()} - before
    for each in waiting:
        os.kill(each, signal.SIGKILL)
    assert eventually(lambda: not any(map(is_alive, waiting)))
    looked.check(path, "a.zip")
    (launcher,) = {*launchers()} - before
    os.kill(launcher, signal.SIGKILL)
    looked.check(path, "a.zip")


DEADLY = """
import os
def serve(wire):
    wire.recv(4096)
    os.abort()
"""


def test_many_that_die_at_once_take_nothing_with_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What ends by itself just when it is let go is met twice by its launcher."""
    read_by(DEADLY, tmp_path, monkeypatch)
    looked, path = ArchiveIndexes(), archive(tmp_path, "p/package.xml")
    looked.start()
    launcher = looked._launcher

    def refused(_: int) -> bool:
        with pytest.raises(UnreadableInput, match="has an index that cannot be read"):
            looked.check(path, "a.zip")
        return True

    with ThreadPoolExecutor(4) as threads:
        assert all(threads.map(refused, range(200)))
    assert looked._launcher is launcher
    assert launcher is not None
    assert launcher.alive


TELLING = """
import json, os, socket
seen = []
def serve(wire):
    while True:
        message, (descriptor,), _, _ = socket.recv_fds(wire, 4096, 1)
        seen.append(descriptor)
        said = repr([os.pread(each, 100, 0) for each in seen])
        for each in seen:
            try:
                os.fchmod(each, 0)
                said += "changed"
            except OSError:
                pass
        wire.sendall(json.dumps({"reason": said, "advice": ""}).encode() + b"\\n")
"""


def test_one_that_was_taken_over_sees_one_archive_and_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(TELLING, tmp_path, monkeypatch)
    looked = ArchiveIndexes()
    for name in ("first", "second", "third", "fourth", "fifth", "sixth"):
        (tmp_path / name).write_text(f"the {name} archive")
        (tmp_path / name).chmod(0o600)
        with pytest.raises(UnreadableInput) as error:
            looked.check(tmp_path / name, "a.zip")
        assert error.value.reason == repr([f"the {name} archive".encode()])
        assert (tmp_path / name).stat().st_mode & 0o777 == 0o600


HOSTILE = """
def serve(wire):
    wire.recv(4096)
    wire.sendall({said!r})
    wire.recv(4096)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "said", [b"", b"\n", b"nonsense\n", b"[" * 5_000 + b"\n", b"x" * 20_000, b"\xff\n"]
)
def test_one_that_was_taken_over_says_nonsense(
    said: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(HOSTILE.format(said=said), tmp_path, monkeypatch)
    if not said:
        monkeypatch.setattr(archive_indexes, "SECONDS", 2.0)
    why = "has an index that cannot be read" if said else "takes more than the 2 s allowed"
    with pytest.raises(UnreadableInput, match=why):
        ArchiveIndexes().check(archive(tmp_path, "p/package.xml"), "a.zip")


GREEDY = """
def serve(wire):
    wire.recv(4096)
    {does}
"""


@pytest.mark.parametrize(
    ("does", "limit"),
    [("while True: pass", "1 s of processor time"), ("bytes(2 * 10**9)", "500 MB of memory")],
)
def test_one_that_takes_too_much_is_told_its_limit(
    does: str, limit: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(GREEDY.format(does=does), tmp_path, monkeypatch)
    monkeypatch.setattr(archive_indexes, "PROCESSOR_SECONDS", 1)
    with pytest.raises(UnreadableInput, match=f"takes more than the {limit} allowed") as error:
        ArchiveIndexes().check(archive(tmp_path, "p/package.xml"), "a.zip")
    assert "pack the package folder again" in error.value.advice


KILLED = """
import os, signal, socket
def serve(wire):
    _, (descriptor,), _, _ = socket.recv_fds(wire, 4096, 1)
    if os.fstat(descriptor).st_size > {size}:
        os.kill(os.getpid(), signal.SIGKILL)
    wire.sendall(b"{{}}\\n")
"""


def test_one_that_is_killed_each_time_is_no_fault_of_the_archive(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = archive(tmp_path, "p/package.xml")
    read_by(KILLED.format(size=path.stat().st_size), tmp_path, monkeypatch)
    ArchiveIndexes().check(path, "a.zip")
    path.write_bytes(path.read_bytes() + b"more")
    with pytest.raises(OSError, match="was killed"):
        ArchiveIndexes().check(path, "a.zip")


def test_what_a_reader_says_of_the_disk_is_no_fault_of_the_archive(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(HOSTILE.format(said=b'{"momentary": "Input/output error"}\n'), tmp_path, monkeypatch)
    with pytest.raises(OSError, match="Input/output error"):
        ArchiveIndexes().check(archive(tmp_path, "p/package.xml"), "a.zip")


@pytest.mark.root
def test_a_disk_that_is_full_for_a_moment(tmp_path: Path) -> None:
    with small_disk(tmp_path / "disk", 2_000_000) as disk:
        looked, path = ArchiveIndexes(), archive(disk, "p/package.xml")
        with full(disk), pytest.raises(OSError, match="No space left"):
            looked.check(path, "a.zip")
        looked.check(path, "a.zip")


def test_a_process_that_cannot_be_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    looked, path = ArchiveIndexes(), archive(tmp_path, "p/package.xml")
    with monkeypatch.context() as patch:
        patch.setattr(sys, "executable", str(tmp_path / "none"))
        with pytest.raises(OSError, match=r"No such file|Connection reset|Broken pipe"):
            looked.check(path, "a.zip")
    looked.check(path, "a.zip")
