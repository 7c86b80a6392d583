"""What the routes of the service work with."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from anyio import CapacityLimiter

from checker.jobs.port import Jobs
from checker.record import record
from checker.store.store import Store
from checker.web.config import Config
from checker.web.gate import Gate
from checker.web.metrics import Metrics

if TYPE_CHECKING:
    from starlette.requests import Request

_ORDERS_AT_ONCE = 2


@record()
class Services:
    """What the routes of the service work with.

    Attributes:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed here.
        gate: Says who may do what.
        metrics: Counts what they do.
        ordering: Lets few order at once. A database that takes one change at a time, such as
            SQLite, has the others look again and again, the longer the later they came.
    """

    jobs: Jobs
    store: Store
    config: Config
    gate: Gate
    metrics: Metrics
    ordering: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(_ORDERS_AT_ONCE))

    def address(self, request: Request) -> str:
        """Return where people reach the service, without a slash at its end."""
        return self.config.base_url or str(request.base_url).rstrip("/")
