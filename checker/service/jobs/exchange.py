"""Exchange between a worker and the process that checks, and the folder of that process."""

from __future__ import annotations

import os
import re
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from checker.base.files import NotReadable, read_bytes
from checker.base.record import Record
from checker.base.sandbox.files import Content, Files
from checker.base.sandbox.task import hold_files_to
from checker.base.sandbox.usage import Usage
from checker.base.system import tighten
from checker.base.words import and_list, plain, shortened
from checker.finding import Severity
from checker.report.files import package_folders
from checker.report.report import Report, VerdictKind
from checker.report.summary import sentence, what_was_checked
from checker.service.jobs.outcome import Checked

# What the check of an upload may use.


NICENESS = 10
"""Priority below that of the processes of the service, as in `nice`."""
TRIAL_NICENESS = 5
"""Priority of trials below static rules: users wait for the first findings."""


MOST = Usage(memory=3_000_000_000, disk=2_000_000_000, files=200_000, processes=64)
"""Limits for all processes of a check together, besides two copies of the upload. Of an archive,
500 MB at most are unpacked. Of 15 uploads of real packages, one of 18 packages, checked with trial
and pictures, none used more than 540 MB of memory, 150 MB of disk, 970 files and 6 processes."""


class StageLimits(Record):
    """Limits of the check of an upload.

    Attributes:
        seconds: Seconds of processor time, for each process.
        clock_seconds: The limit of real time for all of it, also on a busy machine.
        memory: Bytes of address space of the process that checks. Not below what the children of
            the check request themselves: 4 GB for drawing, of which 0.9 GB were ever seen in use.
        file_bytes: Size of one file that it writes.
        open_files: The number of open files at a time.
    """

    seconds: float
    clock_seconds: float = 3600.0
    memory: int = 4_000_000_000
    file_bytes: int = 1_000_000_000
    open_files: int = 512


def limit(limits: StageLimits) -> None:
    """Take too much of everything away from this process; nothing that is tighter is loosened."""
    seconds = max(1, int(limits.seconds))
    # At the soft limit the system sends SIGXCPU: SIGKILL would look as if it came from outside.
    tighten("RLIMIT_CPU", seconds, seconds + 1)
    tighten("RLIMIT_AS", limits.memory, limits.memory)
    hold_files_to(limits.file_bytes, limits.open_files)


# What the state of a check says of its packages: made by the child, read by the worker.


_PACKAGES_LIMIT = 5_000
_TEXT_LIMIT = 1_000
_HALVES = re.compile(r"[\ud800-\udfff]")
_TEXTS, _NUMBERS = ("name", "folder", "kind"), ("errors", "warnings", "infos")


def summary(report: Report) -> dict[str, Any]:
    """Return what a report states in short.

    "packages", as in `State.packages`; "words": what came out, one sentence; "crashed": whether a
    rule could not run because of the checker itself.
    """
    packages = [
        {
            "name": shortened(plain(package.name), _TEXT_LIMIT),
            "verdict": package.verdict.value,
            "errors": package.count(Severity.ERROR),
            "warnings": package.count(Severity.WARNING),
            "infos": package.count(Severity.INFO),
            "folder": folder,
            "kind": package.kind,
        }
        for package, folder in zip(report.packages, package_folders(report), strict=True)
    ]
    words = shortened(_words(report), _TEXT_LIMIT)
    crashed = any(package.crashed for package in report.packages)
    return {"packages": packages, "words": words, "crashed": crashed}


def _words(report: Report) -> str:
    if len(report.packages) == 1:
        return str(sentence(report.packages[0]))
    kinds = Counter(package.verdict for package in report.packages)
    verdicts = [f"{kinds[kind]} {kind.replace('_', ' ')}" for kind in VerdictKind if kinds[kind]]
    return f"{what_was_checked(each.kind for each in report.packages)}: {and_list(verdicts)}"


def read_summary(key: str, data: Any) -> Checked | None:
    """Return what a summary states; None for what is none."""
    match data:
        case {"packages": list(packages), "words": str(words)} if len(
            packages
        ) <= _PACKAGES_LIMIT and all(map(_is_package, packages)):
            names = (*_TEXTS, "verdict", *_NUMBERS)
            kept = tuple({name: package[name] for name in names} for package in packages)
            return Checked(key, kept, shortened(plain(words), _TEXT_LIMIT))
    return None


def _is_package(data: Any) -> bool:
    return (
        isinstance(data, Mapping)
        and all(_is_text(data.get(name)) for name in _TEXTS)
        and data.get("verdict") in list(VerdictKind)
        and all(type(data.get(name)) is int and data[name] >= 0 for name in _NUMBERS)
    )


def _is_text(data: Any) -> bool:
    # A child may write halves of surrogate pairs, which no page can show.
    return isinstance(data, str) and len(data) <= _TEXT_LIMIT and not _HALVES.search(data)


UPLOAD = "upload"
"""Name of the upload among the files of a request."""
GIVEN = "given/upload"
"""Folder of the upload, in which the process runs; reports show neither."""
TEMPORARY = "temporary"
"""Folder of what is unpacked."""
CACHE = "cache"
"""Folder of what was computed, kept from the first stage of a check for its second."""
_PART = re.compile(r"cache/([a-z]{1,40})/([0-9a-f]{2})/(\2[0-9a-f]{62})\.json")
_PART_LIMIT = 200_000_000
_LOOKED_AT = 20_000


def settle(place: Path, name: str, files: Files) -> None:
    """Write the input into a folder, and work there.

    Args:
        place: An empty folder.
        name: The name of the uploaded file.
        files: The upload, and parts of an earlier check of it.
    """
    upload = place / GIVEN
    for folder in (upload, place / TEMPORARY):
        folder.mkdir(parents=True)
    # The search for settings ends at the root of a repository: none of this machine's shall judge.
    (upload.parent / ".git").touch()
    _write(upload / name, files, UPLOAD)
    for part in filter(is_part, files.names):
        (place / part).parent.mkdir(parents=True, exist_ok=True)
        _write(place / part, files, part)
    os.chdir(upload)
    os.environ["TMPDIR"] = str(place / TEMPORARY)
    os.environ["SUBT_CHECK_CACHE"] = str(place / CACHE)
    # A library may have requested it before; and on a full disk, the search for one finds none.
    tempfile.tempdir = str(place / TEMPORARY)


def _write(path: Path, files: Files, name: str) -> None:
    with path.open("wb") as file:
        files.copy(name, file)


def is_part(name: str) -> bool:
    """Return whether a name is that of a part of a check in its cache."""
    return _PART.fullmatch(name) is not None


def new_parts(place: Path, known: Iterable[str]) -> Iterator[tuple[str, Content]]:
    """Yield what a check has computed: names, and what is in them.

    Args:
        place: The folder in which it worked.
        known: Names of what was known before.
    """
    before = set(known)
    for path in sorted((place / CACHE).glob("*/??/*.json"))[:_LOOKED_AT]:
        name = path.relative_to(place).as_posix()
        content = read_bytes(path, name, _PART_LIMIT)
        if is_part(name) and name not in before and not isinstance(content, NotReadable):
            yield name, content
