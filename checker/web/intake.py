"""The file of an upload while it comes."""

from __future__ import annotations

import errno
import os
import shutil
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cached_property

from checker.store.incoming import Incoming
from checker.store.store import Store
from checker.web.clerk.port import Slip
from checker.web.config import Config
from checker.web.refusal import Refused


@dataclass(eq=False)
class Intake:
    """Takes the file of one upload; used by one thread at a time.

    Unless a clerk has taken it by then, nothing of it is left after `close`.

    Attributes:
        size: Bytes so far.
    """

    store: Store
    config: Config
    size: int = 0
    _opened: ExitStack = field(default_factory=ExitStack)

    def write(self, piece: bytes) -> None:
        """Take the next bytes.

        Raises:
            Refused: The disk has no room.
            TooLarge: There are more bytes than allowed.
            OSError: They cannot be written.
        """
        self._incoming.write(piece)
        self.size = self._incoming.size

    def slip(self, name: str, profile: str) -> Slip:
        """Return what to tell a clerk once all bytes are written."""
        return Slip(str(self._incoming.path), name, profile)

    def close(self) -> None:
        """Take no more."""
        self._opened.close()

    @cached_property
    def _incoming(self) -> Incoming:
        self._refuse_without_room()
        return self._opened.enter_context(self.store.incoming(self.config.upload_limit))

    def _refuse_without_room(self) -> None:
        """Refuse all uploads before the disk is so full that no check can be finished."""
        try:
            free = shutil.disk_usage(self.store.folder).free
        except OSError:  # writing will tell
            return
        if free < self.config.room:
            raise no_room(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)))


def no_room(error: OSError) -> Refused:
    """Return the refusal of a file that the disk does not take."""
    reason = error.strerror or "the disk does not answer"
    return Refused(
        503,
        f"The service cannot keep the upload: {reason}.",
        "Try again later.",
        "disk",
        {"Retry-After": "60"},
    )
