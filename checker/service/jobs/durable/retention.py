"""What is deleted, and when: checks after their time, then what nothing refers to any more."""

from __future__ import annotations

import time

import sqlalchemy as sa

from checker.base.record import Record
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.ledger import forget
from checker.service.jobs.durable.queues import Queues
from checker.service.jobs.durable.tables import CHECKS
from checker.service.store.store import Store

_AT_ONCE = 200


class Retention(Record):
    """Deletes what has had its time; any number of workers may do so at once.

    Attributes:
        engine: Of the database.
        queues: Of the same database.
        store: Uploads and results.
        grace_seconds: That a file stays which no check refers to: one may be about to.
    """

    engine: sa.Engine
    queues: Queues
    store: Store
    grace_seconds: float

    def delete(self) -> None:
        """Delete what has had its time."""
        while ids := self._expired():
            self.queues.forget(ids)
            with self.engine.begin() as connection:
                forget(connection, ids)
        self.store.expire(time.time() - self.grace_seconds, self._referred())
        self.store.sweep()

    def _expired(self) -> list[str]:
        over = sa.select(CHECKS.c.id).where(CHECKS.c.expires <= now(self.engine)).limit(_AT_ONCE)
        with self.engine.connect() as connection:
            return list(connection.execute(over).scalars())

    def _referred(self) -> set[str]:
        """Return the hashes and keys that checks refer to."""
        with self.engine.connect() as connection:
            pairs = connection.execute(sa.select(CHECKS.c.upload, CHECKS.c.result).distinct())
            return {part for pair in pairs for part in pair if part}
