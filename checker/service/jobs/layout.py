"""What goes to and fro between a worker and the process that checks, and where that one works."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

from checker.base.disk_file import NotReadable, read_bytes
from checker.base.sandbox.files import Content, Files

UPLOAD = "upload"
"""Name of the upload among the files of a request."""
GIVEN = "given/upload"
"""Folder of the upload, in which the process runs; reports show neither."""
TEMPORARY = "temporary"
"""Folder of what is unpacked."""
CACHE = "cache"
"""Folder of what was worked out, kept from the first stage of a check for its second."""
_PART = re.compile(r"cache/([a-z]{1,40})/([0-9a-f]{2})/(\2[0-9a-f]{62})\.json")
_PART_LIMIT = 200_000_000
_LOOKED_AT = 20_000


def settle(place: Path, name: str, files: Files) -> None:
    """Lay out what was handed over, and work there.

    Args:
        place: An empty folder.
        name: Of the uploaded file.
        files: The upload, and parts of an earlier check of it.
    """
    given = place / GIVEN
    for folder in (given, place / TEMPORARY):
        folder.mkdir(parents=True)
    # The search for settings ends at the root of a repository: none of this machine's shall judge.
    (given.parent / ".git").touch()
    _write(given / name, files, UPLOAD)
    for part in filter(is_part, files.names):
        (place / part).parent.mkdir(parents=True, exist_ok=True)
        _write(place / part, files, part)
    os.chdir(given)
    os.environ["TMPDIR"] = str(place / TEMPORARY)
    os.environ["SUBT_CHECK_CACHE"] = str(place / CACHE)
    tempfile.tempdir = None  # a library may have asked for it before


def _write(path: Path, files: Files, name: str) -> None:
    with path.open("wb") as file:
        files.copy(name, file)


def is_part(name: str) -> bool:
    """Say whether a name is that of a part of a check in its cache."""
    return _PART.fullmatch(name) is not None


def new_parts(place: Path, known: Iterable[str]) -> Iterator[tuple[str, Content]]:
    """Yield what a check has worked out: names, and what is in them.

    Args:
        place: Where it worked.
        known: Names of what was known before.
    """
    before = set(known)
    for path in sorted((place / CACHE).glob("*/??/*.json"))[:_LOOKED_AT]:
        name = path.relative_to(place).as_posix()
        content = read_bytes(path, name, _PART_LIMIT)
        if is_part(name) and name not in before and not isinstance(content, NotReadable):
            yield name, content
