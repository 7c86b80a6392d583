"""Stands for `checker.service.jobs.check_child` where an upload says what to do: `hostile_checker`.

Such an upload holds `HOSTILE`, then JSON with a `deed` and what it needs. All others are checked.
"""

from __future__ import annotations

import json
import mmap
import os
import re
import stat
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

from attempts import ATTEMPTS, LIBC, tried

from checker.base.sandbox.files import Files
from checker.base.sandbox.task import Answer
from checker.service.jobs import check_child

_SAID = re.compile(rb"HOSTILE(.*)HOSTILE", re.DOTALL)
_PACKAGE = {
    "name": "hostile",
    "verdict": "ready",
    "errors": 0,
    "warnings": 0,
    "infos": 0,
    "folder": "",
    "kind": "robot",
}


def answer(request: bytes, files: Files) -> Answer:
    """Do what the upload says."""
    upload = files.read("upload")
    said = _SAID.search(upload) if isinstance(upload, bytes) else None
    if said is None:
        return check_child.answer(request, files)
    asked = json.loads(said[1])
    return DEEDS[asked["deed"]](asked, files)  # type: ignore[no-any-return]


def _summary(**more: Any) -> bytes:
    said = {"packages": [_PACKAGE], "words": "Ready: nothing to fix", "crashed": False}
    return json.dumps(said | more).encode()


def _attempts(asked: Mapping[str, Any], _: Files) -> Answer:
    """Make all attempts, and tell of them in the report."""
    assets = {**asked["assets"], "works": True, "launcher": os.getppid(), "place": str(Path.cwd())}
    said = {name: tried(name, assets) for name in ATTEMPTS if name not in asked["without"]}
    for name in ("index.html", "report.html", "report.json"):
        if Path(name).is_file():
            said[f"found in {name}"] = Path(name).read_text(errors="replace")
    return _summary(), [("report.json", json.dumps(said).encode())]


def _names(asked: Mapping[str, Any], _: Files) -> Answer:
    return _summary(), [("report.json", b"{}"), *((name, b"HOSTILE") for name in asked["names"])]


def _many(asked: Mapping[str, Any], _: Files) -> Answer:
    """Make files without content, more than there is room for names of."""
    return _summary(), ((f"cache/x/00/{number:064x}.json", b"") for number in range(asked["many"]))


def _large(asked: Mapping[str, Any], _: Files) -> NoReturn:
    """Claim one file of a gigabyte, by a hole on the disk, again and again."""
    table = {f"{number}/report.json": [0, 900_000_000] for number in range(asked["many"])}
    _write_raw(_summary(), json.dumps(table).encode(), before=900_000_000)


def _table(asked: Mapping[str, Any], _: Files) -> NoReturn:
    _write_raw(_summary(), json.dumps(asked["table"]).encode())


def _answer(asked: Mapping[str, Any], _: Files) -> bytes:
    """Say something that is no summary."""
    begin, middle, times, end = asked["said"]
    return (begin + middle * times + end).encode()


def _lies(asked: Mapping[str, Any], _: Files) -> bytes:
    return _summary(**asked["more"])


def _seen(_asked: Mapping[str, Any], files: Files) -> Answer:
    """Tell what was handed over, and leave parts under the names of others."""
    parts = [(f"cache/trial/{key[:2]}/{key}.json", b'"HOSTILE"') for key in _asked["keys"]]
    return _summary(words=json.dumps([*files.names])), [("report.json", b"{}"), *parts]


def _leftovers(_asked: Mapping[str, Any], _: Files) -> bytes:
    """Leave what is hard to remove."""
    place = Path.cwd()
    (place / "many").mkdir()
    for number in range(20_000):
        (place / "many" / str(number)).touch()
    for folder in ("closed", "closed/inner"):
        (place / folder).mkdir(mode=0o300)  # to be written into, not to be listed
    (place / "closed/inner/file").touch()
    for _number in range(5_100):
        os.mkdir("deep")  # noqa: PTH102 - the path has no bounds
        os.chdir("deep")
    time.sleep(_asked.get("seconds", 0))
    return _summary()


def _holds(asked: Mapping[str, Any], _: Files) -> bytes:
    """Hold memory that processes share, by several that each hold little."""
    for _number in range(4):
        if os.fork() == 0:
            held = mmap.mmap(-1, asked["bytes"] // 4)
            for _piece in range(asked["bytes"] // 4_000_000):
                held.write(bytes(1_000_000))
            time.sleep(60)
    time.sleep(asked["seconds"])
    return _summary()


def _fills(asked: Mapping[str, Any], _: Files) -> bytes:
    """Fill the disk by files without names."""
    for number in range(4):
        file = Path(str(number)).open("wb", buffering=0)  # noqa: SIM115 - held until the end
        Path(str(number)).unlink()
        for _piece in range(asked["bytes"] // 4_000_000):
            file.write(bytes(1_000_000))
        globals()[f"held{number}"] = file
    time.sleep(asked["seconds"])
    return _summary()


def _multiplies(asked: Mapping[str, Any], _: Files) -> bytes:
    """Start processes that start processes, each in a session of its own if it can."""
    if os.fork() == 0:
        LIBC.prctl(15, asked["mark"].encode(), 0, 0, 0)  # PR_SET_NAME
        ends = time.monotonic() + 30
        while time.monotonic() < ends:
            with suppress(OSError):
                if os.fork() == 0:
                    LIBC.prctl(1, 0, 0, 0, 0)  # PR_SET_PDEATHSIG
                    os.setsid()
    time.sleep(asked["seconds"])
    return _summary()


def _dies(_asked: Mapping[str, Any], _: Files) -> NoReturn:
    os.abort()


def _write_raw(message: bytes, table: bytes, before: int = 0) -> NoReturn:
    """Write an answer of any form, and end."""
    descriptor = [each for each in range(3, 512) if _is_unnamed(each)][1]
    lengths = b"".join(len(each).to_bytes(8, "big") for each in (message, table))
    os.pwrite(descriptor, message + table + lengths, before)
    os._exit(0)


def _is_unnamed(descriptor: int) -> bool:
    try:
        found = os.fstat(descriptor)
    except OSError:
        return False
    return stat.S_ISREG(found.st_mode) and not found.st_nlink


DEEDS = {
    deed.__name__.strip("_"): deed
    for deed in (
        *(_attempts, _names, _many, _large, _table, _answer, _lies, _seen, _leftovers, _dies),
        *(_holds, _fills, _multiplies),
    )
}
