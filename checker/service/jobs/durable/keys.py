"""What stands for a check in the books: a digest of its id, which opens no report.

The id is in the answer to who uploads and in the addresses that they pass on, and nowhere else.
"""

from __future__ import annotations

from hashlib import sha256

LENGTH = 64
"""Characters of a key; an id has 22."""
_DOMAIN = b"subt-check: key of a check\0"
"""Keeps keys apart from other digests of ids, such as those in logs."""


def key_of_check(id: str) -> str:
    """Return the key of a check: SHA-256, hexadecimal.

    A plain digest is enough. An id is 128 random bits: who has its digest would have to try 2¹²⁷ of
    them, so that neither salt nor a slow function would add anything.

    Args:
        id: As it was given to who uploaded, or whatever a client sends for one.
    """
    return sha256(_DOMAIN + id.encode("utf-8", "surrogatepass")).hexdigest()
