"""What the routes of the service work with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import field

from checker.base.record import Record
from checker.service.jobs.port import Jobs
from checker.service.store.store import Store
from checker.service.web.clerk.port import Clerk
from checker.service.web.config import Config
from checker.service.web.gate import Gate
from checker.service.web.metrics import Metrics
from checker.service.web.turns import Turns

if TYPE_CHECKING:
    from starlette.requests import Request


class Services(Record):
    """What the routes of the service work with.

    Attributes:
        jobs: The engine that checks.
        store: Uploads and results.
        clerk: Takes uploads that have come whole.
        config: What is allowed here.
        gate: Says who may do what.
        metrics: Counts what they do.
        turns: Of the uploads that come.
    """

    jobs: Jobs
    store: Store
    clerk: Clerk
    config: Config
    gate: Gate
    metrics: Metrics
    turns: Turns = field(default_factory=Turns)

    def address(self, request: Request) -> str:
        """Return where people reach the service, without a slash at its end."""
        return self.config.base_url or str(request.base_url).rstrip("/")
