"""Room on the disk for uploads that are under way: reserved a little ahead of the received bytes.

With the announced sizes, a sender could reserve the room of all others without sending a byte. What
has been written is no longer free, so only what is still to come is kept from others.
"""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from checker.service.web.answers.refusal import Refused
from checker.service.web.config import Config

_SHARE = 2
"""One client has one of so many parts of the room, unless it has but one upload under way."""
_COPIES = 2
"""Copies of each upload: itself, and the copy from which the index of an archive is read."""
WINDOW = 250_000
"""Bytes that are reserved ahead of what has come; of a longer upload, as many as have come."""


@dataclass(eq=False)
class Claim:
    """Room for one upload.

    Attributes:
        client: The owner.
        size: Bytes that it may take at most.
        reserved: Bytes that it may take so far.
        written: Bytes of them that have come.
    """

    client: str
    size: int
    reserved: int = 0
    written: int = 0

    @property
    def bytes_to_come(self) -> int:
        """Bytes reserved that are not there yet, with those of the copy."""
        return max(_COPIES * self.reserved - self.written, 0)


class Space:
    """Reserves room; used by the event loop alone."""

    def __init__(self, free: Callable[[], int], kept_free: int, per_client: int) -> None:
        """Begin with nothing reserved.

        Args:
            free: Returns the free bytes of the disk; raises OSError if it cannot.
            kept_free: Bytes of them that are for others than uploads.
            per_client: Bytes of all uploads of one client that are under way.
        """
        self._free, self._kept_free, self._per_client = free, kept_free, per_client
        self._claims: list[Claim] = []

    @contextmanager
    def reserve(self, client: str, size: int) -> Iterator[Claim]:
        """Reserve room for the beginning of an upload, as long as it is under way.

        Args:
            client: The owner.
            size: Bytes that it may take at most.

        Raises:
            Refused: There is no room for all of it now, or its client has its part already.
        """
        claim = Claim(client, size)
        self._refuse_beyond(claim, size)
        self._refuse_share(claim)
        claim.reserved = min(size, WINDOW)
        self._claims.append(claim)
        try:
            yield claim
        finally:
            self._claims.remove(claim)

    def extend(self, claim: Claim, size: int) -> None:
        """Reserve room for so many bytes of an upload, and for some that follow.

        Args:
            claim: The claim of the upload.
            size: Bytes including those that are written next.

        Raises:
            Refused: There is no such room any more.
        """
        if claim.reserved < min(size, claim.size):
            reservation = min(size + max(size, WINDOW), claim.size)
            self._refuse_beyond(claim, reservation)
            claim.reserved = reservation

    def _refuse_beyond(self, claim: Claim, size: int) -> None:
        room = self._room()
        others = sum(each.bytes_to_come for each in self._claims if each is not claim)
        if room is not None and room < _COPIES * size - claim.written + others:
            raise no_room(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)))

    def _refuse_share(self, claim: Claim) -> None:
        """Refuse a new upload of a client that announces more than its part."""
        room = self._room()
        held = sum(each.size for each in self._claims if each.client == claim.client)
        if room is None or not held:
            return
        room += sum(each.written for each in self._claims)
        if held + claim.size > min(self._per_client, room // _COPIES // _SHARE):
            raise _too_much(held)

    def _room(self) -> int | None:
        """Return the bytes that uploads may still take; None if only writing shows it."""
        try:
            return self._free() - self._kept_free
        except OSError:
            return None


def space_of(folder: Path, config: Config) -> Space:
    """Return the room of a folder, which may not be there yet.

    Args:
        folder: The folder of the store.
        config: The share of it for uploads.
    """
    return Space(partial(_free_bytes, folder), config.room, config.bytes_per_client)


def _free_bytes(folder: Path) -> int:
    return shutil.disk_usage(folder).free


def no_room(error: OSError) -> Refused:
    """Return the refusal of an upload that the disk cannot take."""
    reason = error.strerror or "the disk does not answer"
    return Refused(
        503,
        f"The service cannot keep the upload: {reason}.",
        "Try again later.",
        "disk",
        {"Retry-After": "60"},
    )


def _too_much(held: int) -> Refused:
    return Refused(
        503,
        f"Uploads of {held / 1e6:.0f} MB are in progress from this address; "
        "there is no room for another one.",
        "Try again when one of them has ended.",
        "busy",
        {"Retry-After": "5"},
    )
