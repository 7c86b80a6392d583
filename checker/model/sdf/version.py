"""The SDF version of a file: one reading of it for everything that depends on it."""

from __future__ import annotations

import re

from checker.source.xml import XmlDocument

FALLBACK = (1, 6)
"""What a file without a readable version is read as."""

_VERSION = re.compile(r"\s*(\d{1,4})\.(\d{1,4})\s*", re.ASCII)


def sdf_version(document: XmlDocument) -> tuple[int, int]:
    """Return the version that `<sdf>` states, as (1, 6); (1, 6) when it cannot be read."""
    return parse_version(document.root.get("version") or "") or FALLBACK


def parse_version(text: str) -> tuple[int, int] | None:
    """Read `1.6`, blanks around it aside; None for anything else."""
    match = _VERSION.fullmatch(text)
    return (int(match[1]), int(match[2])) if match else None
