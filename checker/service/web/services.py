"""Objects that the routes of the service use."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from anyio import CapacityLimiter
from msgspec import field

from checker.base.record import Record
from checker.service.jobs.port import Jobs, State
from checker.service.store.store import Store
from checker.service.web.answers.refusal import not_found
from checker.service.web.api.watchers import Watchers
from checker.service.web.config import Config
from checker.service.web.limits.admission import Admission
from checker.service.web.limits.lines import Lines
from checker.service.web.limits.space import Space
from checker.service.web.metrics import Metrics
from checker.service.web.uploads.archive_indexes import ArchiveIndexes

if TYPE_CHECKING:
    from starlette.requests import Request

_ID = re.compile(r"[A-Za-z0-9_-]{1,64}")
"""Form of an id; the database is not queried for other texts."""
AT_ONCE, OF_ONE = 16, 4
"""Uploads, and those of one sender; most take 10 ms, some archives seconds."""


class Services(Record):
    """Objects that the routes of the service use.

    Attributes:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed here.
        admission: The permissions of clients.
        metrics: Counts what they do.
        indexes: Reads those of archives.
        watchers: Follow checks.
        space: Room on the disk for uploads.
        threads: The threads that read, store and order complete uploads.
        lines: Before these threads, one for each sender.
    """

    jobs: Jobs
    store: Store
    config: Config
    admission: Admission
    metrics: Metrics
    indexes: ArchiveIndexes
    watchers: Watchers
    space: Space
    threads: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(AT_ONCE))
    lines: Lines = field(default_factory=lambda: Lines(AT_ONCE, OF_ONE))

    def check(self, id: str) -> State:
        """Return where a check stands.

        Args:
            id: The id as a client sends it.

        Raises:
            Refused: There is none; the answer is one and the same for all ids.
            JobsUnreachable: The database does not answer.
        """
        state = self.jobs.status(id) if _ID.fullmatch(id) else None
        if state is None:
            raise not_found()
        return state

    def address(self, request: Request) -> str:
        """Return where people reach the service, without a slash at its end."""
        return self.config.base_url or str(request.base_url).rstrip("/")
