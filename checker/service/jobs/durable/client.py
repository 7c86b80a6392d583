"""The job engine as the web process has it: it takes orders and answers, and checks nothing."""

from __future__ import annotations

import secrets
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime, timedelta
from statistics import median
from time import time

from msgspec.structs import replace

from checker.base.record import Record
from checker.service.jobs.check import stored_result
from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import open_database, reachable
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.pulse import watch
from checker.service.jobs.durable.receipts import digest_of_secret, key_of_check, receipt_for
from checker.service.jobs.durable.senders import Senders
from checker.service.jobs.durable.tasks import STAGES, End, Row, Task, events_of, state_of
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import (
    RETENTION_DAYS,
    Alive,
    Event,
    Order,
    Receipt,
    Stage,
    State,
)
from checker.service.store.store import Store

_DAY = 86400.0
_LEAST_SECONDS, _SECONDS_PER_BYTE = 0.5, 5e-7
"""Times of the static rules: a real package of a megabyte takes about a second."""
_PACED = 25
"""Stages whose median duration of the last day is used: earlier durations state nothing of
now."""


class DurableJobs(Record):
    """`Jobs` on a database: SQLite or PostgreSQL.

    Ids, which open reports, and secrets, which end checks, end here: what is behind knows them by
    their digests alone.

    Attributes:
        checks: The checks in the database.
        senders: The senders in the same database.
        store: Uploads and results.
        retention_days: After which all of a check is deleted.
    """

    checks: Checks
    senders: Senders
    store: Store
    retention_days: float = RETENTION_DAYS

    def submit(self, order: Order, key: str = "") -> Receipt:
        """Take an order and return its receipt; once it returns, the order is not lost.

        What was checked before, with the same content, name, profile and program, is not checked
        again: the new check finishes at once and shares the report.

        Args:
            order: The requested check.
            key: The same order with the same key gets the same receipt; empty for a new one.
        """
        receipt = receipt_for(order, key or secrets.token_urlsafe(32))
        known = stored_result(self.store, order, Stage.TRIAL)
        created = round(time(), 3)
        task = Task(
            key_of_check(receipt.id),
            replace(order, sender=""),
            created,
            created + self.retention_days * _DAY,
            cost=self._cost(order),
            secret=digest_of_secret(receipt.secret),
            end=End(Stage.DONE, known.words, known.key, known.packages) if known else None,
        )
        with reachable():
            self.checks.enter(replace(task, sender=self.senders.digest(order.sender)))
        return receipt

    def _cost(self, order: Order) -> float:
        """Return the seconds that the static rules take, estimated from the size of an upload."""
        upload = self.store.upload(order.upload)
        size = upload.stat().st_size if upload is not None else 0
        return _LEAST_SECONDS + size * _SECONDS_PER_BYTE

    def status(self, id: str) -> State | None:
        """Return the state of a check; None for an id that was never given or is forgotten."""
        with reachable():
            rows = self._rows(id)
            state = state_of(id, rows)
            if state is None or state.stage.is_final or rows[-1].begun:
                return state
            return replace(state, ahead=self.checks.count_ahead(rows[-1].task))

    def events(self, after: Mapping[str, int]) -> Mapping[str, Sequence[Event]]:
        """Return what has happened to checks, of each behind the number of an event.

        Args:
            after: Numbers by the ids of checks; 0 for all events. Those not known are left out.
        """
        keys = {key_of_check(id): id for id in after}
        with reachable():
            found = self.checks.rows(keys)
        by_check = {keys[key]: events_of(rows) for key, rows in found.items()}
        return {
            id: [event for event in events if event.number > after[id]]
            for id, events in by_check.items()
            if events
        }

    def cancel(self, id: str, secret: str) -> bool:
        """End a check, unless it is over; False if the secret is not the one of this check."""
        with reachable():
            rows = self._rows(id)
            may = _has_secret(rows, secret)
            if may and not events_of(rows)[-1].stage.is_final:
                self.checks.cancel(key_of_check(id))
        return may

    def delete(self, id: str, secret: str) -> bool:
        """End a check and forget it at once; False if the secret is not the one of this check."""
        with reachable():
            may = _has_secret(self._rows(id), secret)
            if may:
                self.checks.forget([key_of_check(id)])
        return may

    def wait(self, client: str, per_minute: int) -> float:
        """Count an upload in all web processes, and return 0; or the seconds until one is allowed.

        SQLite serves a single web process, which counts by itself.
        """
        if self.checks.engine.dialect.name == "sqlite":
            return 0.0
        with reachable():
            return self.senders.wait(client, per_minute)

    def stage_seconds(self) -> Mapping[str, float]:
        """Return what each stage took lately, the median of some checks; those that are known."""
        with reachable():
            taken = {stage.value: self._seconds(stage) for stage in STAGES}
        return {name: seconds for name, seconds in taken.items() if seconds}

    def _seconds(self, stage: Stage) -> float:
        """Return the median of what a stage took lately, seconds; 0 if that is not known."""
        rows = self.checks.client.list_workflows(
            name=stage.value,
            status="SUCCESS",
            completed_after=(datetime.now(UTC) - timedelta(days=1)).isoformat(),
            sort_desc=True,
            limit=_PACED,
            load_input=False,
            load_output=False,
        )
        taken = [
            (row.completed_at - row.dequeued_at) / 1e3
            for row in rows
            if row.completed_at and row.dequeued_at
        ]
        return median(taken) if taken else 0.0

    def alive(self) -> Alive:
        """Return what is known of the engine."""
        with reachable():
            silence, layers = Workers(self.checks.engine).worker_states()
            waiting = dict(self.checks.waiting())
        running = waiting.pop("")
        return Alive(silence, waiting, running, layers)

    def _rows(self, id: str) -> Sequence[Row]:
        key = key_of_check(id)
        return self.checks.rows([key]).get(key, ())


def _has_secret(rows: Sequence[Row], secret: str) -> bool:
    """Return whether a check is known and has a secret."""
    return bool(events_of(rows)) and secrets.compare_digest(
        rows[0].task.secret, digest_of_secret(secret)
    )


def durable_jobs(
    database_url: str, store: Store, retention_days: float = RETENTION_DAYS
) -> DurableJobs:
    """Return the engine; its tables are made if they are missing.

    Args:
        database_url: `sqlite:///…` or `postgresql://…`.
        store: Uploads and results.
        retention_days: After which all of a check is deleted.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    engine = open_database(database_url)
    if engine.dialect.name == "postgresql":
        watch(engine)
    return DurableJobs(prepare_database(engine), Senders(engine), store, retention_days)
