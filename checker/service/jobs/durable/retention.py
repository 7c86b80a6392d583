"""Deletion of checks after their time, and then of what nothing refers to any more."""

from __future__ import annotations

import time
from collections.abc import Mapping

from checker.base.record import Record
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.senders import Senders
from checker.service.store.store import Store

UNUSED_SECONDS = 3600.0
"""Time that files without a check are kept: a check may be about to use them."""
_AT_ONCE = 200


class Retention(Record):
    """Deletes expired objects; any number of workers may do so at once.

    Attributes:
        checks: The checks in the database.
        store: Uploads and results.
        grace_seconds: The time for which a file without a check is kept.
    """

    checks: Checks
    store: Store
    grace_seconds: float = UNUSED_SECONDS

    def delete(self) -> Mapping[str, int]:
        """Delete what has had its time; return how many of each kind went."""
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
        gone = self.store.expire(began - self.grace_seconds, referred)
        self.store.sweep()
        Senders(self.checks.engine).forget()
        return {"checks": len(keys)} | {kind.value: number for kind, number in gone.items()}
