"""Names that clients send, made safe; they are shown and tell the kind, and never become paths."""

from __future__ import annotations

import re

from checker.package.archives.archive import ARCHIVE_SUFFIXES
from checker.package.inputs import SINGLE_FILE_SUFFIXES

SUFFIXES = (*ARCHIVE_SUFFIXES, *SINGLE_FILE_SUFFIXES)
LENGTH_LIMIT = 100
_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
_NAMELESS = "upload"


class UnknownKind(ValueError):
    """A file name that says of nothing that can be checked; the text is one sentence."""

    def __init__(self) -> None:
        known = ", ".join(SUFFIXES[:-1])
        super().__init__(f"the file's name ends in none of {known} and {SUFFIXES[-1]}")


def safe_name(given: str) -> str:
    """Return a file name of letters, digits, `-`, `_` and `.`, of at most 100 characters.

    Args:
        given: As the client says it: a name, or a path as some browsers send it.

    Raises:
        UnknownKind: Its ending is of no archive and no model file.
    """
    base = re.split(r"[/\\]", given)[-1].strip()
    suffix = next((each for each in SUFFIXES if base.lower().endswith(each)), None)
    if suffix is None:
        raise UnknownKind
    stem = _UNSAFE.sub("_", base[: -len(suffix)]).strip("._-")
    return (stem[: LENGTH_LIMIT - len(suffix)].rstrip("._-") or _NAMELESS) + suffix
