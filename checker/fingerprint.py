"""Fingerprints: what tells one fault from another, wherever its lines move."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable

_LINE_NUMBER = re.compile(r"\bline \d+")


def fingerprint(*parts: str) -> str:
    """Return 16 hexadecimal digits that stand for these texts in this order."""
    return hashlib.sha256("\0".join(parts).encode(errors="surrogatepass")).hexdigest()[:16]


def without_line_numbers(message: str) -> str:
    """Return a message in which no number changes when lines move."""
    return _LINE_NUMBER.sub("line", message)


def numbered(bases: Iterable[str]) -> list[str]:
    """Return fingerprints that are all different: the second of one base gets a number, …."""
    seen: dict[str, int] = {}
    distinct = []
    for base in bases:
        number = seen.get(base, 0)
        seen[base] = number + 1
        distinct.append(fingerprint(base, str(number)) if number else base)
    return distinct
