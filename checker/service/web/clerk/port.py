"""What is done with an upload once all of it has come, and who can be asked to do it."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from checker.base.errors import UnreadableInput
from checker.base.record import Record
from checker.base.words import plain
from checker.package.archives.archive import ARCHIVE_SUFFIXES
from checker.service.jobs.port import Jobs, Order
from checker.service.store.incoming import content_hash
from checker.service.store.store import Store
from checker.service.web.clerk.indexes import Indexes
from checker.service.web.refusal import Refused, sentence


class Slip(Record):
    """An upload that has come whole.

    Attributes:
        path: Where it lies meanwhile, in the store's file system.
        name: Of the file, made safe.
        profile: Of the check; empty for what suits.
    """

    path: str
    name: str
    profile: str


class Clerk(Protocol):
    """Takes uploads."""

    async def take(self, slip: Slip) -> str:
        """Look at an upload, keep it, order its check, and return the id of the check.

        Raises:
            Refused: It is an archive that could do harm, or damaged: no check can be of use.
            JobsUnreachable: The order cannot be taken now.
            OSError: The upload cannot be kept.
        """
        ...


def looked_at(slip: Slip, indexes: Indexes) -> Order:
    """Look at an upload, and return what is to be ordered; raises as `Clerk.take` does."""
    if slip.name.lower().endswith(ARCHIVE_SUFFIXES):
        _check_index(slip, indexes)
    return Order(content_hash(Path(slip.path)), slip.name, slip.profile)


def accepted(slip: Slip, order: Order, store: Store, jobs: Jobs) -> str:
    """Keep an upload, order its check, and return its id; raises as `Clerk.take` does."""
    store.admit(Path(slip.path), order.upload)
    return jobs.submit(order)


def _check_index(slip: Slip, indexes: Indexes) -> None:
    try:
        indexes.check(Path(slip.path), slip.name)
    except UnreadableInput as error:
        reason = plain(f"{slip.name} {error.reason}.")
        raise Refused(422, reason, sentence(error.advice), "archive") from None
