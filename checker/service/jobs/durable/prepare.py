"""Makes the tables that are missing, and takes over the checks of versions before DBOS's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.database import (
    METADATA,
    SCHEMA,
    client_of,
    configure_logging,
    reachable,
)
from checker.service.jobs.durable.receipts import key_of_check
from checker.service.jobs.durable.senders import RATES, SALTS
from checker.service.jobs.durable.tasks import KNOWN, STAGES, End, Task
from checker.service.jobs.durable.workers import WORKERS
from checker.service.jobs.port import Order, Stage

if TYPE_CHECKING:
    from dbos import DBOSClient

_OURS = (WORKERS, SALTS, RATES)
_LOCK = 7_302_815_601
"""The number of the advisory lock in PostgreSQL; any that others do not use."""
_OLD = "subt_checks"
_OLD_TABLES = (_OLD, "subt_events", "subt_queues")
_KEY_LENGTH = 64
"""The length of a digest; version 0.1.0 wrote ids, which are shorter."""


def prepare_database(engine: sa.Engine, trials: int = 0) -> Checks:
    """Return the checks of a database, with all tables made; many may do so at once.

    Args:
        engine: The engine of the database.
        trials: The number of trials of each sender at once on each worker; 0 leaves the queues as
            they are.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    from dbos import DBOS

    configure_logging()
    with reachable():
        with engine.begin() as connection:  # the first on SQLite sets how it writes
            _lock(connection)
            _drop_others(connection)
            METADATA.create_all(connection, _OURS)
        DBOS.migrate(engine.url.render_as_string(hide_password=False), schema=SCHEMA)
        client = client_of(engine)
        if trials:
            _make_queues(client, trials)
        checks = Checks(engine, client)
        _take_over(engine, checks)
        return checks


def _drop_others(connection: sa.Connection) -> None:
    """Drop those of our tables that another version has made with other columns."""
    inspector = sa.inspect(connection)
    for table in _OURS:
        if not inspector.has_table(table.name):
            continue
        if {each["name"] for each in inspector.get_columns(table.name)} != {*table.columns.keys()}:
            table.drop(connection)


def _make_queues(client: DBOSClient, trials: int) -> None:
    """Write how many tasks a worker takes at once, in all and of one sender.

    One place is for other senders: however many long checks one sender sends, the first findings of
    others do not wait for them.
    """
    static, trial = (stage.value for stage in STAGES)
    for name, places, seconds in ((static, 1, 0.25), (trial, trials, 0.5)):
        client.register_queue(
            name,
            worker_concurrency=places + 1,
            partition_worker_concurrency=places,
            polling_interval_sec=seconds,
        )
    client.register_queue(KNOWN, polling_interval_sec=5.0)


def _take_over(engine: sa.Engine, checks: Checks) -> None:
    """Enter the checks of the tables that older versions had, and drop these.

    Several may enter the same checks, each of which is there once.
    """
    with engine.begin() as connection:
        _lock(connection)  # another may drop them
        if not sa.inspect(connection).has_table(_OLD):
            return
        old = sa.Table(_OLD, sa.MetaData(), autoload_with=connection)
        rows = connection.execute(sa.select(old)).mappings().all()
    for row in rows:
        checks.enter(_task_of(row))
    with engine.begin() as connection:
        _lock(connection)
        for name in _OLD_TABLES:
            connection.exec_driver_sql(f"DROP TABLE IF EXISTS {name}")


def _task_of(row: Any) -> Task:
    """Return an old check: over, or to be begun again, which finds what it had in the store."""
    stage = Stage(row["stage"])
    over = End(stage, row["words"], row["result"], tuple(row["packages"]))
    return Task(
        row["id"] if len(row["id"]) == _KEY_LENGTH else key_of_check(row["id"]),
        Order(row["upload"], row["name"], row["profile"]),
        row["created"],
        row["expires"],
        sender="nobody",
        cost=row.get("cost", 0.0),
        secret=row.get("secret", ""),
        end=over if stage.is_final else None,
    )


def _lock(connection: sa.Connection) -> None:
    """Block others until the end of this transaction."""
    if connection.dialect.name == "sqlite":
        connection.exec_driver_sql("BEGIN IMMEDIATE")
    else:
        connection.execute(sa.select(sa.func.pg_advisory_xact_lock(_LOCK)))
