"""Bounded reading of one text file."""

from __future__ import annotations

from pathlib import Path

from checker.disk_file import NotReadable, read_bytes
from checker.source.decode import NotText, decode, encoding_of
from checker.source.text import SourceText

TEXT_LIMIT = 20_000_000
"""Bytes; the largest text of 99 real packages is below 1 MB."""


def read_text(location: Path, path: str, limit: int = TEXT_LIMIT) -> SourceText | NotReadable:
    """Read a text file; `path` becomes the source's file."""
    data = read_bytes(location, path, limit)
    if isinstance(data, NotReadable):
        return data
    try:
        return SourceText(path, decode(data), encoding=encoding_of(data))
    except NotText as error:
        return NotReadable(path, str(error))
