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
from checker.web.uploads.archive_indexes import ArchiveIndexes

if TYPE_CHECKING:
    from starlette.requests import Request

_AT_ONCE = 16
"""Uploads; most take 10 ms, some archives seconds."""


@record()
class Services:
    """What the routes of the service work with.

    Attributes:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed here.
        gate: Says who may do what.
        metrics: Counts what they do.
        indexes: Reads those of archives.
        takers: Let a few uploads that have come whole be looked at, kept and ordered at once.
    """

    jobs: Jobs
    store: Store
    config: Config
    gate: Gate
    metrics: Metrics
    indexes: ArchiveIndexes
    takers: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(_AT_ONCE))

    def address(self, request: Request) -> str:
        """Return where people reach the service, without a slash at its end."""
        return self.config.base_url or str(request.base_url).rstrip("/")
