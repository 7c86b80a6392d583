"""What the routes of the service work with."""

from __future__ import annotations

from dataclasses import dataclass

from checker.jobs.port import Jobs
from checker.store.store import Store
from checker.web.config import Config


@dataclass(frozen=True)
class Services:
    """What the routes of the service work with.

    Attributes:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed here.
    """

    jobs: Jobs
    store: Store
    config: Config
