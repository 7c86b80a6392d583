"""Books in which ids of checks stand in the clear, as version 0.1.0 writes them, are hashed.

Old links lead to their checks as before. Any number of processes may do this at once, and any of
them may be killed: the next one goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import sqlalchemy as sa

from checker.service.jobs.durable.keys import LENGTH, key_of_check
from checker.service.jobs.durable.queues import WAITS, Queues, queues_of
from checker.service.jobs.durable.tables import CHECKS, EVENTS
from checker.service.jobs.port import Stage

_AT_ONCE = 200
_LOCK = 7_302_815_602
"""Of PostgreSQL's advisory locks, beside that of `checker.service.jobs.durable.database`."""
_FINAL = [stage.value for stage in Stage if stage.is_final]


def hash_clear_ids(engine: sa.Engine) -> None:
    """Put keys in place of all ids; checks that are not over wait again, under their keys.

    SQLite's file is written anew, so that no id is left in what is free there. What PostgreSQL has
    replaced is in no dump; its own files hold it until `VACUUM FULL`.
    """
    if _in_clear(engine):
        with _alone(engine):
            _hash_all(engine)
    if engine.dialect.name == "sqlite":
        _write_anew(engine)


@contextmanager
def _alone(engine: sa.Engine) -> Iterator[None]:
    """Have others wait: PostgreSQL ends one of two that change the same rows in another order."""
    with engine.begin() as connection:
        if engine.dialect.name != "sqlite":
            connection.execute(sa.select(sa.func.pg_advisory_xact_lock(_LOCK)))
        yield


def _hash_all(engine: sa.Engine) -> None:
    queues = queues_of(engine)
    while ids := _in_clear(engine):
        # Before, or they would stay if this process died behind the change; and after, since a
        # worker of the old version may have queued a trial meanwhile.
        queues.forget(ids)
        with engine.begin() as connection:
            _hash(connection, queues, ids)
        queues.forget(ids)


def _in_clear(engine: sa.Engine) -> Sequence[str]:
    """Return some ids that are no keys, those of the oldest checks first."""
    clear = sa.select(CHECKS.c.id).where(sa.func.length(CHECKS.c.id) < LENGTH)
    with engine.connect() as connection:
        return connection.execute(clear.order_by(CHECKS.c.created).limit(_AT_ONCE)).scalars().all()


def _hash(connection: sa.Connection, queues: Queues, ids: Sequence[str]) -> None:
    if connection.dialect.name == "sqlite":
        # Before it is read: a worker of the old version may be about to change it.
        connection.exec_driver_sql("BEGIN IMMEDIATE")
        connection.exec_driver_sql("PRAGMA user_version=1")  # until it is written anew
    these = sa.select(CHECKS).where(CHECKS.c.id.in_(ids)).order_by(CHECKS.c.created)
    for found in connection.execute(these.with_for_update()).all():
        key = key_of_check(found.id)
        is_over = found.stage in _FINAL
        values = {"id": key} if is_over else {"id": key, **_waiting(found)}
        connection.execute(sa.update(CHECKS).where(CHECKS.c.id == found.id).values(values))
        told = sa.update(EVENTS).where(EVENTS.c.check_id == found.id)
        connection.execute(told.values(check_id=key))
        if not is_over:
            trial = found.stage == Stage.TRIAL
            queues.put(connection, key, Stage.TRIAL if trial else Stage.STATIC)


def _waiting(found: sa.Row[Any]) -> dict[str, Any]:
    """Return what makes a check wait: who has it in hand loses its turn, through no fault."""
    if not found.worker:
        return {}
    return {"worker": "", "turn": found.turn + 1, "words": WAITS}


def _write_anew(engine: sa.Engine) -> None:
    """Leave no bytes of what was changed, if something was; again at the next start if we die."""
    with engine.connect() as connection:
        if not connection.exec_driver_sql("PRAGMA user_version").scalar():
            return
        connection.exec_driver_sql("VACUUM")
        busy, *_ = connection.exec_driver_sql("PRAGMA wal_checkpoint(TRUNCATE)").one()
        if not busy:
            connection.exec_driver_sql("PRAGMA user_version=0")
