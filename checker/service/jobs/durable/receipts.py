"""Receipts: the id and the secret of a check, made of its order and of a seed."""

from __future__ import annotations

from base64 import urlsafe_b64encode
from hashlib import sha256

from checker.service.jobs.port import Order, Receipt

_CHARACTERS = 22
"""Of an id and of a secret, six bits each."""


def receipt_for(order: Order, seed: str) -> Receipt:
    """Return the receipt of an order, always the same one for the same order and seed.

    Args:
        order: What is asked for.
        seed: Unguessable; without it, neither the id nor the secret tells the other.
    """
    parts = (seed, order.upload, order.name, order.profile)
    return Receipt(
        _derived("subt-check: id of a check", *parts),
        _derived("subt-check: secret of a check", *parts),
    )


def digest_of_secret(secret: str) -> str:
    """Return what the table keeps of a secret: SHA-256, hexadecimal; it ends no check."""
    return sha256(_joined("subt-check: digest of a secret", secret)).hexdigest()


def _derived(*parts: str) -> str:
    digest = sha256(_joined(*parts)).digest()
    return urlsafe_b64encode(digest).decode("ascii")[:_CHARACTERS]


def _joined(*parts: str) -> bytes:
    """Return texts, each behind its length: no two lists of texts read the same."""
    texts = [part.encode("utf-8", "surrogatepass") for part in parts]
    return b"".join(len(text).to_bytes(8) + text for text in texts)
