"""Changes that several threads make at once share a transaction: what takes long is its end.

A transaction waits for the disk, and where the database takes one at a time, as SQLite does, for
those of all other processes; how much is changed in it hardly matters (group commit).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from threading import Lock

import msgspec
import sqlalchemy as sa

from checker.base.record import Record
from checker.service.jobs.durable.database import AWAY

Change = Callable[[sa.Connection], None]
"""What holds as a part of a transaction, or not at all."""


@dataclass(eq=False)
class _Wanted:
    """A change that a thread waits for; `failed` says why it was not made."""

    change: Change
    made: bool = False
    failed: Exception | None = None


class Together(Record, eq=False):
    """Makes changes in as few transactions as can be.

    Attributes:
        engine: Of the database.
    """

    engine: sa.Engine
    _turn: Lock = msgspec.field(default_factory=Lock)
    _waiting: list[_Wanted] = msgspec.field(default_factory=list)

    def make(self, change: Change) -> None:
        """Make a change, and return once it holds; it may be tried again if another one fails.

        Raises:
            Exception: What the change raises, or the database; then it does not hold.
        """
        wanted = _Wanted(change)
        self._waiting.append(wanted)
        with self._turn:
            if not (wanted.made or wanted.failed):
                waiting = [*self._waiting]
                del self._waiting[: len(waiting)]  # others may have come meanwhile
                self._make_all(waiting)
        if wanted.failed is not None:
            raise wanted.failed

    def _make_all(self, waiting: Sequence[_Wanted]) -> None:
        try:
            with self.engine.begin() as connection:
                for each in waiting:
                    each.change(connection)
        except Exception as error:  # noqa: BLE001 - it belongs to who asked for the change
            if len(waiting) == 1 or isinstance(error, AWAY):
                for each in waiting:
                    each.failed = error
                return
            # One of them may be at fault for all.
            for each in waiting:
                self._make_all([each])
        else:
            for each in waiting:
                each.made = True
