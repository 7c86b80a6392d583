"""The database: a SQLite file on one machine, or PostgreSQL for several."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from checker.jobs.durable.tables import METADATA
from checker.jobs.port import JobsUnreachable

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
}
_BUSY_MILLISECONDS = 30_000
_NO_ADDRESS = "the database's address cannot be read, expected sqlite:///… or postgresql://…"
"""Said without the address: it may hold a password."""
_MIGRATION_LOCK = 7_302_815_601
"""Of PostgreSQL's advisory locks; any number that others do not use."""


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
    except (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError) as error:
        raise JobsUnreachable(f"the database does not answer ({type(error).__name__})") from error


def prepare(engine: sa.Engine) -> None:
    """Make the tables that are missing: DBOS's own and the ledger's; many may do so at once.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    from dbos import DBOS

    with reachable():
        with engine.connect():
            pass
        DBOS.migrate(engine.url.render_as_string(hide_password=False))
        with engine.begin() as connection:
            if engine.dialect.name == "sqlite":
                connection.exec_driver_sql("BEGIN IMMEDIATE")
            else:
                connection.execute(sa.select(sa.func.pg_advisory_xact_lock(_MIGRATION_LOCK)))
            METADATA.create_all(connection)


def now(engine: sa.Engine) -> sa.ColumnElement[float]:
    """Return the database's clock, seconds since the epoch: clocks of machines may differ."""
    if engine.dialect.name == "sqlite":
        return (sa.func.julianday("now", type_=sa.Double) - 2440587.5) * 86400.0
    return sa.cast(sa.extract("epoch", sa.func.clock_timestamp()), sa.Double)


def _sqlite(address: sa.URL) -> sa.Engine:
    if address.database:
        Path(address.database).parent.mkdir(mode=0o700, parents=True, exist_ok=True)
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
