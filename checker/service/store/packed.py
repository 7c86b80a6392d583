"""Compressed files of a result, made once, when the result is kept; browsers are sent these.

Pages among them lead back to the page of their check: what others fetch is theirs, without a link
that leads nowhere there.
"""

from __future__ import annotations

import gzip
import re
from pathlib import Path

from checker.report.files import ARTEFACT_NAME, INDEX

SUFFIX = ".gz"
LARGEST = 32_000_000
"""Bytes of a file that is compressed; a larger one is sent as it is."""
_GAIN = 0.9
"""Share of its bytes: a file that stays larger, such as a picture, is sent as it is."""
_BEGIN = 65_536
"""Bytes of a page that contain its style, and the start of its header."""
_HEADER = re.compile(rb'<header(?: class="[a-z_ ]*")?>')


def pack(folder: Path) -> None:
    """Add compressed files to those of a result."""
    for path in [*folder.glob("*"), *folder.glob("*/*")]:
        name = path.relative_to(folder).as_posix()
        if not ARTEFACT_NAME.fullmatch(name) or path.stat().st_size > LARGEST:
            continue
        content = path.read_bytes()
        page = _with_way_back(content, name) if name.endswith(".html") else content
        packed = gzip.compress(page, compresslevel=6, mtime=0)
        if len(packed) < _GAIN * len(content):
            path.with_name(path.name + SUFFIX).write_bytes(packed)


def _with_way_back(page: bytes, name: str) -> bytes:
    """Return a page with a link in its header to the folder of all files of its check."""
    way = "../" if name == INDEX else "../../" if "/" in name else "./"
    link = f'<p class="back"><a href="{way}">Back to the check</a></p>'
    begin = _HEADER.sub(lambda header: header[0] + b"\n" + link.encode(), page[:_BEGIN], count=1)
    return begin + page[_BEGIN:]
