"""Receipts: the id and the secret of a check, and the digests by which the database knows them."""

from __future__ import annotations

from base64 import urlsafe_b64encode
from hashlib import sha256

from checker.service.jobs.port import Order, Receipt

_CHARACTERS = 22
"""Length of an id and of a secret, six bits a character."""
_KEY = b"subt-check: key of a check\0"
"""Keeps keys apart from other digests of ids."""
SHOWN_DIGITS = 12
"""Length of a key in logs and lists: enough to distinguish checks."""


def receipt_for(order: Order, seed: str) -> Receipt:
    """Return the receipt of an order, always the same one for the same order and seed.

    Args:
        order: The requested check.
        seed: An unguessable text; without it, neither id nor secret follows from the other.
    """
    parts = (seed, order.upload, order.name, order.profile)
    return Receipt(
        _derived("subt-check: id of a check", *parts),
        _derived("subt-check: secret of a check", *parts),
    )


def key_of_check(id: str) -> str:
    """Return what represents a check in the database: SHA-256, hexadecimal; it opens no report.

    The id is in the answer to the sender and in the addresses that they pass on, and nowhere else.
    A plain digest is enough: an id is 128 random bits, and an attacker with its digest would have
    to try 2¹²⁷ of them, so that neither salt nor a slow function would add anything.

    Args:
        id: The id as the sender got it, or any text that a client sends.
    """
    return sha256(_KEY + id.encode("utf-8", "surrogatepass")).hexdigest()


def digest_of_secret(secret: str) -> str:
    """Return what the database keeps of a secret: SHA-256, hexadecimal; it ends no check."""
    return sha256(_joined("subt-check: digest of a secret", secret)).hexdigest()


def _derived(*parts: str) -> str:
    digest = sha256(_joined(*parts)).digest()
    # Where it began with "-", a command would take it for an option.
    return urlsafe_b64encode(digest).decode("ascii").lstrip("-")[:_CHARACTERS]


def _joined(*parts: str) -> bytes:
    """Return texts, each behind its length: no two lists of texts read the same."""
    texts = [part.encode("utf-8", "surrogatepass") for part in parts]
    return b"".join(len(text).to_bytes(8) + text for text in texts)
