"""What is deleted, and when: checks after their time, then what nothing refers to any more."""

from __future__ import annotations

import time

from checker.base.record import Record
from checker.service.jobs.durable.checks import Checks
from checker.service.store.store import Store

_AT_ONCE = 200


class Retention(Record):
    """Deletes what has had its time; any number of workers may do so at once.

    Attributes:
        checks: In the database.
        store: Uploads and results.
        grace_seconds: That a file stays which no check refers to: one may be about to.
    """

    checks: Checks
    store: Store
    grace_seconds: float

    def delete(self) -> None:
        """Delete what has had its time."""
        began = time.time()
        expired: set[str] = set()
        referred: set[str] = set()
        for row in self.checks.all_rows():
            if row.task.expires <= began:
                expired.add(row.task.key)
                continue
            referred |= {row.task.order.upload, row.task.result, row.end.result if row.end else ""}
        keys = sorted(expired)
        for start in range(0, len(keys), _AT_ONCE):
            self.checks.forget(keys[start : start + _AT_ONCE])
        self.store.expire(began - self.grace_seconds, referred)
        self.store.sweep()
