"""Fingerprints: what tells one fault from another, wherever its lines move."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable


def fingerprint(*parts: str) -> str:
    """Return 16 hexadecimal digits that stand for these texts in this order."""
    return hashlib.sha256("\0".join(parts).encode(errors="surrogatepass")).hexdigest()[:16]


def numbered(bases: Iterable[str]) -> list[str]:
    """Return fingerprints that are all different: the second of one base gets a number, …."""
    seen: dict[str, int] = {}
    distinct = []
    for base in bases:
        number = seen.get(base, 0)
        seen[base] = number + 1
        distinct.append(fingerprint(base, str(number)) if number else base)
    return distinct


def bases_of(fingerprints: Iterable[str]) -> list[str]:
    """Undo `numbered`: return what each fingerprint was made of."""
    seen: dict[str, int] = {}
    expected: dict[str, str] = {}
    bases = []
    for each in fingerprints:
        base = expected.pop(each, each)
        seen[base] = seen.get(base, 0) + 1
        expected[fingerprint(base, str(seen[base]))] = base
        bases.append(base)
    return bases
