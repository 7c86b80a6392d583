"""Files that were made to do harm: refused with the reason, and nothing of them stays."""

from __future__ import annotations

import gzip
import io
import struct
import tarfile
import zipfile
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.web.board import BoardJobs
from tests.web.server import left_behind
from tests.web.test_transfer import GOOD, zipped

SYMLINK, DEVICE = 0o120777 << 16, 0o020666 << 16


def zipped_as(attributes: int, content: bytes) -> bytes:
    """Return a zip archive of one entry with attributes of Unix."""
    info = zipfile.ZipInfo("rover/model.sdf")
    info.create_system, info.external_attr = 3, attributes
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(info, content)
    return file.getvalue()


def tarred(name: str, kind: bytes = tarfile.REGTYPE, target: str = "", size: int = 0) -> bytes:
    """Return a gzipped tar archive of one entry."""
    info = tarfile.TarInfo(name)
    info.type, info.linkname, info.size = kind, target, size
    file = io.BytesIO()
    with tarfile.open(fileobj=file, mode="w:gz") as archive:
        archive.addfile(info, io.BytesIO(bytes(size)))
    return file.getvalue()


def twice(archive: bytes) -> bytes:
    """Return a zip archive of one entry whose index names the same bytes a thousand times."""
    start, end = archive.index(b"PK\x01\x02"), archive.index(b"PK\x05\x06")
    entry = archive[start:end]
    entries = b"".join(entry.replace(b"rover/0000", b"rover/%04d" % n) for n in range(1_000))
    index = struct.pack("<HHII", 1_000, 1_000, len(entries), start)
    return archive[:start] + entries + b"PK\x05\x06\0\0\0\0" + index + b"\0\0"


LARGE = bytes(11_000_000)
ARCHIVES = {
    "10 000 files": ("a.zip", zipped(*((f"rover/{n}", b"") for n in range(10_000))), "entries"),
    "a symbolic link": ("a.zip", zipped_as(SYMLINK, b"/etc/passwd"), "link"),
    "a device": ("a.zip", zipped_as(DEVICE, b""), "device"),
    "a path up": ("a.zip", zipped(("rover/../../x", b"x")), "leads out"),
    "a path of Windows": ("a.zip", zipped(("C:\\x", b"x")), "drive letter"),
    "a name with a colour": ("a.zip", zipped(("rover/\x1b[31m", b"x")), "control"),
    "names that run backwards": (
        "a.zip",
        zipped(("\u202ea", b"x"), ("\u202eA", b"x")),
        "upper and lower case",
    ),
    "a bomb": ("a.zip", zipped(("rover/x", LARGE)), "200 times"),
    "a bomb of many": ("a.zip", twice(zipped(("rover/0000", LARGE[:100_000]))), "200 times"),
    "a hard link": ("a.tar.gz", tarred("rover/x", tarfile.LNKTYPE, "/etc/passwd"), "link"),
    "a device in a tar": ("a.tgz", tarred("rover/x", tarfile.CHRTYPE), "device"),
    "a pipe": ("a.tgz", tarred("rover/x", tarfile.FIFOTYPE), "pipe"),
    "a path up in a tar": ("a.tar.gz", tarred("../../x"), "leads out"),
    "a root in a tar": ("a.tar.gz", tarred("/etc/cron.d/x"), "absolute"),
    "a bomb of gzip": ("a.tar.gz", tarred("rover/x", size=60_000_000), "200 times"),
    "an endless gzip": ("a.tar.gz", gzip.compress(bytes(60_000_000)), ""),
    "half a gzip": ("a.tar.gz", tarred("rover/x", size=9)[:60], ""),
    "no index": ("a.zip", GOOD[: GOOD.index(b"PK\x01\x02")], "cut off"),
    "an index of another file": ("a.zip", GOOD[:40] + GOOD[-22:], ""),
}
OTHERS = {
    "a program": ("a.zip", b"\x7fELF" + bytes(600)),
    "a picture": ("a.svg", b"<svg onload='alert(1)'/>"),
    "a page": ("a.html", b"<html><script>alert(1)</script></html>"),
    "an archive that is none": ("a.tar.gz", GOOD),
    "a model that is none": ("a.urdf", GOOD),
    "a model of nothing": ("a.sdf", b" " * 10_000),
}


def refusal(folder: Path, name: str, content: bytes) -> tuple[int, str]:
    """Return status and reason of an upload that is refused, and of which nothing stays."""
    jobs, store = BoardJobs(), Store(folder)
    client = TestClient(create_app(jobs, store, Config()), base_url="http://localhost")
    answer = client.post("/api/checks", files={"file": (name, content, "application/zip")})
    assert not jobs.states, answer.text
    assert left_behind(store) == []
    said = answer.json()
    assert said["advice"].endswith(".")
    return answer.status_code, said["error"]


@pytest.mark.parametrize("case", ARCHIVES)
def test_an_archive(tmp_path: Path, case: str) -> None:
    name, content, said = ARCHIVES[case]
    status, error = refusal(tmp_path, name, content)
    assert status == 422
    assert said in error
    assert error.startswith(name)
    assert error.isprintable()


@pytest.mark.parametrize("case", OTHERS)
def test_what_is_no_archive_and_no_model(tmp_path: Path, case: str) -> None:
    status, error = refusal(tmp_path, *OTHERS[case])
    assert status == 415
    assert "does not end in" in error or "has the name of" in error
