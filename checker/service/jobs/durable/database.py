"""The database: a SQLite file on one machine, or PostgreSQL for several; DBOS has its tables there.

DBOS would open SQLite without a write-ahead log, so that readers and writers wait for each other:
it is given our engines.
"""

from __future__ import annotations

import logging
import os
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import sqlalchemy as sa

from checker.base.errors import CheckerError
from checker.base.files import tighten
from checker.base.words import plain, shortened
from checker.service.jobs.port import JobsUnreachable
from checker.service.store.place import DATABASE, data_folder

if TYPE_CHECKING:
    from dbos import DBOSClient

APPLICATION = "subt-check"
"""The name of this program for DBOS; it may serve others in the same database."""
SCHEMA = "subt_check"
"""The schema of its tables in PostgreSQL."""
CONNECT_SECONDS = 5
"""Time after which a server that does not answer counts as unreachable."""
POOL_SIZE = 20
"""Connections at most, made as they are needed and then kept: to make one takes longer than to use
it."""
_POOL: Mapping[str, Any] = {
    "pool_size": POOL_SIZE,
    "max_overflow": 0,
    "pool_timeout": 15,  # seconds that a thread waits for one of them
    "pool_use_lifo": True,
    "hide_parameters": True,  # names of files are their senders', and errors get into logs
}
_BUSY_MILLISECONDS = 30_000
_SWITCH_SECONDS = 0.02
_NO_ADDRESS = (
    "SUBT_CHECK_DATABASE_URL is not the address of a shared database, expected sqlite:///FILE or "
    "postgresql://…"
)
"""Message without the address, which may contain a password."""
AWAY = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError)
_SHOWN = 200
METADATA = sa.MetaData()
"""Our own tables, besides those of DBOS. Nothing in them is worth keeping: they are made again
where their columns differ."""


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
        CheckerError: The address is none, or its kind is not known.
    """
    try:
        address = sa.make_url(url)
    except (sa.exc.ArgumentError, ValueError):
        raise CheckerError(_NO_ADDRESS) from None
    if address.get_backend_name() == "sqlite":
        return _sqlite(address)
    if address.get_backend_name() not in ("postgres", "postgresql"):
        raise CheckerError(_NO_ADDRESS)
    return sa.create_engine(
        address.set(drivername="postgresql+psycopg"),
        pool_pre_ping=True,
        **_POOL,
        connect_args={"connect_timeout": CONNECT_SECONDS},
    )


@contextmanager
def reachable() -> Iterator[None]:
    """State of a database that does not answer that it is unreachable.

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


def now(engine: sa.Engine) -> sa.ColumnElement[float]:
    """Return the database's clock, seconds since the epoch: clocks of machines may differ."""
    if engine.dialect.name == "sqlite":
        return (sa.func.julianday("now", type_=sa.Double) - 2440587.5) * 86400.0
    return sa.cast(sa.extract("epoch", sa.func.clock_timestamp()), sa.Double)


def client_of(engine: sa.Engine) -> DBOSClient:
    """Return the connection to DBOS's tables; where the database is away, it fails at once."""
    from dbos import DBOSClient, DBOSPortableJSONSerializer

    configure_logging()
    return DBOSClient(
        system_database_engine=engine,
        dbos_system_schema=SCHEMA,
        serializer=DBOSPortableJSONSerializer(),
        application_name=APPLICATION,
        lazy=True,
        retry_connection_errors=False,
    )


def configure_logging() -> None:
    """Make DBOS log by the handlers of this process, warnings and errors only."""
    logger = logging.getLogger("dbos")
    logger.setLevel(logging.WARNING)
    if not logger.handlers:  # else it makes one of its own
        logger.addHandler(logging.NullHandler())
        logger.addFilter(_is_amiss)


def _is_amiss(record: logging.LogRecord) -> bool:
    """Return whether it is worth a line: not the cancellation or deletion of a running check."""
    from dbos import error

    raised = record.exc_info[1] if record.exc_info else None
    harmless = (error.DBOSNonExistentWorkflowError, error.DBOSWorkflowCancelledError)
    return not isinstance(raised, harmless)


def _cause(error: sa.exc.SQLAlchemyError) -> str:
    """Return what the database stated, without the SQL statement."""
    cause = getattr(error, "orig", None) or type(error).__name__
    return plain(shortened(str(cause).partition("\n")[0], _SHOWN))


def _make(file: Path) -> None:
    """Make the file, for its owner alone: SQLite would let all read it, and its companion files.

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
        raise CheckerError(_NO_ADDRESS)
    _make(Path(address.database))
    engine = sa.create_engine(address, **_POOL)

    @sa.event.listens_for(engine, "connect")
    def _configure(connection: Any, _record: Any) -> None:
        # Writers queue up from the start of a transaction, and readers never wait for them.
        connection.isolation_level = "IMMEDIATE"
        connection.execute(f"PRAGMA busy_timeout={_BUSY_MILLISECONDS}")
        _write_ahead(connection)
        connection.execute("PRAGMA synchronous=FULL")
        connection.execute("PRAGMA foreign_keys=ON")

    return engine


def _write_ahead(connection: Any) -> None:
    """Switch the file to a write-ahead log.

    SQLite reports "locked" at once, whatever the timeout, to all but one of those that switch a new
    file in the same moment: each would wait for the other.
    """
    deadline = monotonic() + _BUSY_MILLISECONDS / 1000
    while True:
        try:
            connection.execute("PRAGMA journal_mode=WAL")
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode != sqlite3.SQLITE_BUSY or monotonic() > deadline:
                raise
            sleep(_SWITCH_SECONDS)
        else:
            return
