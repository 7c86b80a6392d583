"""A clerk within the web process, for few uploads at once."""

from __future__ import annotations

from anyio import CapacityLimiter, to_thread
from msgspec import field

from checker.base.record import Record
from checker.service.jobs.port import Jobs
from checker.service.store.store import Store
from checker.service.web.clerk.indexes import Indexes
from checker.service.web.clerk.port import Slip, accepted, looked_at

_AT_ONCE = 2


class ThreadClerk(Record):
    """Takes uploads in threads: a `Clerk`.

    Attributes:
        store: Keeps uploads.
        jobs: Take orders.
        limiter: Lets few work at once.
        indexes: Reads those of archives.
    """

    store: Store
    jobs: Jobs
    limiter: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(_AT_ONCE))
    indexes: Indexes = field(default_factory=Indexes)

    async def take(self, slip: Slip) -> str:
        """See `Clerk.take`."""
        return await to_thread.run_sync(self._taken, slip, limiter=self.limiter)

    def _taken(self, slip: Slip) -> str:
        return accepted(slip, looked_at(slip, self.indexes), self.store, self.jobs)
