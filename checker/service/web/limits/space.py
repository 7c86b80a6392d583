"""Room on the disk for uploads that are under way: reserved when they begin, by what they announce.

What has been written is no longer free, so only what is still to come is kept from others.
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
"""Of each upload: itself, and the copy from which the index of an archive is read."""


@dataclass(eq=False)
class Claim:
    """Room for one upload.

    Attributes:
        client: Whose it is.
        size: Bytes that it may take.
        written: Bytes of them so far.
    """

    client: str
    size: int
    written: int = 0

    @property
    def to_come(self) -> int:
        """Bytes that are not there yet, with those of the copy."""
        return max(_COPIES * self.size - self.written, 0)


class Space:
    """Reserves room; used by the event loop alone."""

    def __init__(self, free: Callable[[], int], kept_free: int, per_client: int) -> None:
        """Begin with nothing reserved.

        Args:
            free: Tells how many bytes of the disk are free; raises OSError if it cannot.
            kept_free: Bytes of them that are for others than uploads.
            per_client: Bytes of all uploads of one client that are under way.
        """
        self._free, self._kept_free, self._per_client = free, kept_free, per_client
        self._claims: list[Claim] = []

    @contextmanager
    def reserve(self, client: str, size: int) -> Iterator[Claim]:
        """Reserve room for an upload as long as it is under way.

        Args:
            client: Whose it is.
            size: Bytes that it may take.

        Raises:
            Refused: There is no such room, or its client has its part already.
        """
        self._refuse_beyond(client, size)
        claim = Claim(client, size)
        self._claims.append(claim)
        try:
            yield claim
        finally:
            self._claims.remove(claim)

    def _refuse_beyond(self, client: str, size: int) -> None:
        try:
            room = self._free() - self._kept_free
        except OSError:  # writing will tell
            return
        if room < _COPIES * size + sum(claim.to_come for claim in self._claims):
            raise no_room(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)))
        room += sum(claim.written for claim in self._claims)
        held = sum(claim.size for claim in self._claims if claim.client == client)
        if held and held + size > min(self._per_client, room // _COPIES // _SHARE):
            raise _too_much(held)


def space_of(folder: Path, config: Config) -> Space:
    """Return the room of a folder, which may not be there yet.

    Args:
        folder: Of the store.
        config: How much of it is for uploads.
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
