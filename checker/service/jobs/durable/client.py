"""The job engine as the web process has it: it takes orders and answers, and checks nothing."""

from __future__ import annotations

import secrets
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property

import sqlalchemy as sa
from msgspec.structs import replace

from checker.base.record import Record
from checker.service.jobs.check import stored_result
from checker.service.jobs.durable.changes import Changes
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import open_database, prepare, reachable
from checker.service.jobs.durable.pace import pace_of
from checker.service.jobs.durable.receipts import digest_of_secret, receipt_for
from checker.service.jobs.durable.steps import Step
from checker.service.jobs.durable.tables import WAITS, key_of_check
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.outcome import Checked
from checker.service.jobs.port import (
    RETENTION_DAYS,
    Alive,
    Event,
    Order,
    Pace,
    Receipt,
    Stage,
    State,
)
from checker.service.store.store import Store

_DAY = 86400.0
_LEAST_SECONDS, _SECONDS_PER_BYTE = 0.5, 5e-7
"""Of the static rules: of real packages, those of a megabyte take about a second."""


class DurableJobs(Record, dict=True):
    """`Jobs` on a database: SQLite or PostgreSQL.

    Ids, which open reports, and secrets, which end checks, end here: what lies behind knows them by
    their digests alone.

    Attributes:
        engine: Of the database, prepared.
        store: Uploads and results.
        retention_days: After which all of a check is deleted.
    """

    engine: sa.Engine
    store: Store
    retention_days: float = RETENTION_DAYS

    @cached_property
    def checks(self) -> Checks:
        """The table of checks."""
        return Checks(self.engine)

    def submit(self, order: Order, key: str = "") -> Receipt:
        """Take an order and return its receipt; once it returns, the order is not lost.

        What was checked before, with the same content, name, profile and program, is not checked
        again: the new check finishes at once and shares the report.

        Args:
            order: What is asked for.
            key: The same order with the same key gets the same receipt; empty for a new one.
        """
        receipt = receipt_for(order, key or secrets.token_urlsafe(32))
        id, secret = key_of_check(receipt.id), digest_of_secret(receipt.secret)
        known = stored_result(self.store, order, Stage.TRIAL)
        step = finished(known) if known else Step("queued", Stage.QUEUED, WAITS)
        keep, cost = self.retention_days * _DAY, self._cost(order)
        with reachable():
            self.checks.enter(id, secret, order, keep, step, cost)
        return receipt

    def _cost(self, order: Order) -> float:
        """Return the seconds that the static rules take, as far as the size of an upload tells."""
        upload = self.store.upload(order.upload)
        size = upload.stat().st_size if upload is not None else 0
        return _LEAST_SECONDS + size * _SECONDS_PER_BYTE

    def status(self, id: str) -> State | None:
        """Return where a check stands; None for an id that was never given or is forgotten."""
        with reachable():
            state = self.checks.state(key_of_check(id))
        return state and replace(state, id=id)

    def events(self, id: str, after: int = 0) -> Sequence[Event]:
        """Return what has happened so far after event number `after`, in order."""
        with reachable():
            return self.checks.events.after(key_of_check(id), after)

    def last_events(self, ids: Collection[str]) -> Mapping[str, int]:
        """Return the number of the last event of each of these checks that is known."""
        keys = {key_of_check(id): id for id in ids}
        with reachable():
            return {keys[key]: last for key, last in self.checks.events.last(keys).items()}

    def changes(self) -> Changes:
        """Return what hears that something changed, at any check."""
        return Changes(self.engine)

    def cancel(self, id: str, secret: str) -> bool:
        """End a check, unless it is over; False if the secret is not the one of this check."""
        key = key_of_check(id)
        with reachable():
            may = self.checks.has_secret(key, digest_of_secret(secret))
            if may:
                self.checks.cancel(key)
        return may

    def delete(self, id: str, secret: str) -> bool:
        """End a check and forget it at once; False if the secret is not the one of this check."""
        key = key_of_check(id)
        with reachable():
            may = self.checks.has_secret(key, digest_of_secret(secret))
            if may:
                self.checks.delete(key)
        return may

    def result(self, id: str) -> str:
        """Return the key of the final report in the store; empty while there is none."""
        state = self.status(id)
        return state.result if state is not None and state.stage is Stage.DONE else ""

    def pace(self) -> Pace:
        """Return how long checks took lately."""
        with reachable():
            return pace_of(self.engine)

    def alive(self) -> Alive:
        """Return what is known of the engine."""
        with reachable():
            silence, layers = Workers(self.engine).known()
            waiting, running = self.checks.waiting()
        return Alive(silence, waiting, running, layers)


def durable_jobs(
    database_url: str, store: Store, retention_days: float = RETENTION_DAYS
) -> DurableJobs:
    """Return the engine; its tables are made if they are missing.

    Args:
        database_url: `sqlite:///…` or `postgresql://…`.
        store: Uploads and results.
        retention_days: After which all of a new check is deleted.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    engine = open_database(database_url)
    prepare(engine)
    return DurableJobs(engine, store, retention_days)


def finished(checked: Checked) -> Step:
    """Return the last step of a check with a report."""
    data = {"result": checked.key}
    return Step("end", Stage.DONE, checked.words, checked.key, checked.packages, data)
