"""The database: a SQLite file on one machine, or PostgreSQL for several."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import quote

import sqlalchemy as sa

from checker.base.files import tighten
from checker.base.words import plain, shortened
from checker.service.jobs.durable.tables import (
    CHECKS,
    EVENTS,
    FINAL,
    LENGTH,
    WAITS,
    key_of_check,
    make_tables,
)
from checker.service.jobs.port import JobsUnreachable
from checker.service.store.place import DATABASE, data_folder

# What older versions left: 0.1.0 wrote ids of checks in the clear, and had its queues in tables of
# a library (DBOS), with ids of their own.
#
# Old links lead to their checks as before. Any number of processes may do this at once, and any of
# them may be killed: the next one goes on.


_AT_ONCE = 200
_OF_LIBRARY = (
    *("operation_outputs", "notifications", "workflow_events", "workflow_events_history"),
    *("streams", "workflow_schedules", "application_versions", "queues", "workflow_input"),
    *("workflow_output", "workflow_status", "dbos_migrations"),
)
"""Tables that it made in SQLite's file; in PostgreSQL they have a schema of their own."""
_IN_QUEUES = "DELETE FROM dbos.workflow_status WHERE name IN ('static', 'trial')"


def upgrade(engine: sa.Engine) -> None:
    """Put keys in place of all ids, and have what was in the library's queues wait in ours.

    SQLite's file is written anew, so that no id is left in what is free there. What PostgreSQL has
    replaced is in no dump; its own files hold it until `VACUUM FULL`.
    """
    while ids := _in_clear(engine):
        with engine.begin() as connection:
            _hash(connection, ids)
    _leave_library(engine)
    if engine.dialect.name == "sqlite":
        _write_anew(engine)


def _in_clear(engine: sa.Engine) -> Sequence[str]:
    """Return some ids that are no keys, those of the oldest checks first."""
    clear = sa.select(CHECKS.c.id).where(sa.func.length(CHECKS.c.id) < LENGTH)
    with engine.connect() as connection:
        return connection.execute(clear.order_by(CHECKS.c.created).limit(_AT_ONCE)).scalars().all()


def _hash(connection: sa.Connection, ids: Sequence[str]) -> None:
    _lock(connection)
    if connection.dialect.name == "sqlite":
        connection.exec_driver_sql("PRAGMA user_version=1")  # until it is written anew
    these = sa.select(CHECKS.c.id).where(CHECKS.c.id.in_(ids))
    for id in connection.execute(these).scalars().all():
        key = key_of_check(id)
        connection.execute(sa.update(CHECKS).where(CHECKS.c.id == id).values(id=key))
        update = sa.update(EVENTS).where(EVENTS.c.check_id == id)
        connection.execute(update.values(check_id=key))


def _leave_library(engine: sa.Engine) -> None:
    """Have checks of its queues wait: who had one in hand has lost it, through no fault."""
    in_hand = (CHECKS.c.worker != "", CHECKS.c.stage.not_in(FINAL))
    waits = sa.update(CHECKS).where(*in_hand).values(worker="", words=WAITS)
    is_sqlite = engine.dialect.name == "sqlite"
    with engine.begin() as connection:
        _lock(connection)
        inspector = sa.inspect(connection)
        if not inspector.has_table("workflow_status", schema=None if is_sqlite else "dbos"):
            return
        if is_sqlite:
            for name in _OF_LIBRARY:
                connection.exec_driver_sql(f"DROP TABLE IF EXISTS {name}")
            connection.exec_driver_sql("PRAGMA user_version=1")  # until it is written anew
            connection.execute(waits)
        # Another program may use the library in the same database.
        elif connection.exec_driver_sql(_IN_QUEUES).rowcount:
            connection.execute(waits)


def _lock(connection: sa.Connection) -> None:
    """Have others wait until the end of this transaction."""
    if connection.dialect.name == "sqlite":
        connection.exec_driver_sql("BEGIN IMMEDIATE")
    else:
        connection.execute(sa.select(sa.func.pg_advisory_xact_lock(_LOCK)))


def _write_anew(engine: sa.Engine) -> None:
    """Leave no bytes of what was changed, if something was; again at the next start if we die."""
    with engine.connect() as connection:
        if not connection.exec_driver_sql("PRAGMA user_version").scalar():
            return
        connection.exec_driver_sql("VACUUM")
        busy, *_ = connection.exec_driver_sql("PRAGMA wal_checkpoint(TRUNCATE)").one()
        if not busy:
            connection.exec_driver_sql("PRAGMA user_version=0")


CONNECT_SECONDS = 5
"""After which a server that does not answer counts as unreachable."""
POOL_SIZE = 20
"""Connections at most, made as they are needed and then kept: to make one takes longer than to use
it."""
_POOL_SECONDS = 15
"""That a thread waits for one of them."""
_POOL: Mapping[str, Any] = {
    "pool_size": POOL_SIZE,
    "max_overflow": 0,
    "pool_timeout": _POOL_SECONDS,
    "pool_use_lifo": True,
    "hide_parameters": True,  # names of files are their senders', and errors get into logs
}
_BUSY_MILLISECONDS = 30_000
_NO_ADDRESS = (
    "SUBT_CHECK_DATABASE_URL is not the address of a shared database, expected sqlite:///FILE or "
    "postgresql://…"
)
"""Said without the address: it may hold a password."""
AWAY = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError)
_SHOWN = 200
_LOCK = 7_302_815_601
"""Of PostgreSQL's advisory locks; any number that others do not use."""


def database_url() -> str:
    """Return the address of the database: `SUBT_CHECK_DATABASE_URL`, else a file with the data."""
    own = os.environ.get("SUBT_CHECK_DATABASE_URL", "")
    # SQLAlchemy takes what follows a `?` for options.
    return own or f"sqlite:///{quote(str(data_folder() / DATABASE))}"


def open_database(url: str) -> sa.Engine:
    """Return a pool of connections; none is made yet.

    Args:
        url: `sqlite:///…` or `postgresql://…`.

    Raises:
        JobsUnreachable: The address is none, or its kind is not known.
    """
    try:
        address = sa.make_url(url)
    except (sa.exc.ArgumentError, ValueError):
        raise JobsUnreachable(_NO_ADDRESS) from None
    if address.get_backend_name() == "sqlite":
        return _sqlite(address)
    if address.get_backend_name() not in ("postgres", "postgresql"):
        raise JobsUnreachable(_NO_ADDRESS)
    return sa.create_engine(
        address.set(drivername="postgresql+psycopg"),
        pool_pre_ping=True,
        **_POOL,
        connect_args={"connect_timeout": CONNECT_SECONDS},
    )


@contextmanager
def reachable() -> Iterator[None]:
    """Say of a database that does not answer that it is unreachable.

    Raises:
        JobsUnreachable: It did not answer.
    """
    try:
        yield
    except AWAY as error:
        raise JobsUnreachable(f"the database does not answer: {_cause(error)}") from error
    except sa.exc.DatabaseError as error:
        if type(error) is not sa.exc.DatabaseError:
            raise
        # What SQLite says of a file that is damaged, or is none of its own.
        raise JobsUnreachable(f"the database cannot be read: {_cause(error)}") from error


def prepare(engine: sa.Engine) -> None:
    """Make the tables that are missing, and upgrade older ones.

    Many may do so at once.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    with reachable():
        with engine.begin() as connection:
            _lock(connection)
            make_tables(connection)
        upgrade(engine)


def now(engine: sa.Engine) -> sa.ColumnElement[float]:
    """Return the database's clock, seconds since the epoch: clocks of machines may differ."""
    if engine.dialect.name == "sqlite":
        return (sa.func.julianday("now", type_=sa.Double) - 2440587.5) * 86400.0
    return sa.cast(sa.extract("epoch", sa.func.clock_timestamp()), sa.Double)


def _cause(error: sa.exc.SQLAlchemyError) -> str:
    """Return what the database said, without the statement that it was asked."""
    cause = getattr(error, "orig", None) or type(error).__name__
    return plain(shortened(str(cause).partition("\n")[0], _SHOWN))


def _make(file: Path) -> None:
    """Make the file, for its owner alone: SQLite would let all read it, and what lies beside it.

    Raises:
        JobsUnreachable: It cannot be made or written.
    """
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        os.close(os.open(file, os.O_RDWR | os.O_CREAT, 0o600))
        for suffix in ("", "-wal", "-shm"):  # of an older version, or a copy
            tighten(file.with_name(file.name + suffix))
    except OSError as error:
        reason = error.strerror or "it cannot be opened"
        raise JobsUnreachable(f"the database {file} cannot be written ({reason})") from None


def _sqlite(address: sa.URL) -> sa.Engine:
    if address.database in (None, "", ":memory:"):  # each process would have one of its own
        raise JobsUnreachable(_NO_ADDRESS)
    _make(Path(address.database))
    engine = sa.create_engine(address, **_POOL)

    @sa.event.listens_for(engine, "connect")
    def _configure(connection: Any, _record: Any) -> None:
        # Writers queue up from the start of a transaction, and readers never wait for them.
        connection.isolation_level = "IMMEDIATE"
        connection.execute(f"PRAGMA busy_timeout={_BUSY_MILLISECONDS}")
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("PRAGMA synchronous=FULL")
        connection.execute("PRAGMA foreign_keys=ON")

    return engine
