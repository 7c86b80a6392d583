"""Hears that something in the database changed, so that nobody has to ask it again and again.

PostgreSQL says so itself, to a connection that listens. SQLite keeps a number that differs after
each change of its file; to read it takes microseconds.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from threading import Event, Lock
from time import monotonic
from typing import Any, Protocol

import sqlalchemy as sa

CHANNEL = "subt_check"
POLL_SECONDS = 0.1
"""Between two looks at the number of SQLite."""
SLICE_SECONDS = 0.5
"""After which one who waits looks whether it shall end."""
AWAY_SECONDS = 1.0
"""Before a database that is away is asked again."""
_KEEPALIVES: Mapping[str, int] = {
    "keepalives_idle": 30,
    "keepalives_interval": 10,
    "keepalives_count": 3,
}
"""Seconds, and a number. Who listens sends nothing: nothing else would tell that a machine is
gone."""
_TELLING = sa.text("SELECT pg_notify(:channel, :key)")


def tell(connection: sa.Connection, key: str) -> None:
    """Tell all who listen, once the transaction holds, that a check changed.

    Args:
        connection: In the transaction that changes it.
        key: Of the check.
    """
    if connection.dialect.name != "sqlite":
        connection.execute(_TELLING, {"channel": CHANNEL, "key": key})


class Changes:
    """Hears that something in the database changed: of a check, and on SQLite of anything.

    A database that is away is never an error here: who is told of a change and looks sees it.
    """

    def __init__(self, engine: sa.Engine) -> None:
        self._engine = engine
        self._errors = (engine.dialect.loaded_dbapi.Error, OSError)
        self._closed, self._waiting = Event(), Lock()
        self._listener: _Listener | None = None

    def wait(self, seconds: float) -> bool:
        """Wait until something changed since the last call.

        A new connection counts as a change, as nobody heard what happened before; so does a lost
        one, a second later. One thread waits at a time.

        Args:
            seconds: At most, while the database answers.

        Returns:
            False if nothing changed, and at once after `close`.
        """
        with self._waiting:
            heard = not self._closed.is_set() and self._waited(seconds)
        if self._closed.is_set():
            self.close()
        return heard

    def close(self) -> None:
        """End the connection; who waits returns within half a second, and ends it then."""
        self._closed.set()
        if self._waiting.acquire(blocking=False):
            try:
                self._hang_up()
            finally:
                self._waiting.release()

    def _waited(self, seconds: float) -> bool:
        try:
            if self._listener is None:
                self._listener = _listener(self._engine)
                return True
            return self._hears(self._listener, seconds)
        except self._errors:
            self._hang_up()
            return not self._closed.wait(AWAY_SECONDS)

    def _hears(self, listener: _Listener, seconds: float) -> bool:
        ends = monotonic() + seconds
        while not self._closed.is_set():
            left = ends - monotonic()
            if listener.hears(max(0.0, min(left, SLICE_SECONDS))):
                return True
            if left <= SLICE_SECONDS:
                return False
        return False

    def _hang_up(self) -> None:
        if self._listener is not None:
            with suppress(*self._errors):
                self._listener.connection.close()
        self._listener = None


class _Listener(Protocol):
    """A connection beside those of the pool."""

    connection: Any

    def hears(self, seconds: float) -> bool:
        """Wait for a change; False if there was none."""
        ...


def _listener(engine: sa.Engine) -> _Listener:
    from checker.service.jobs.durable.database import CONNECT_SECONDS

    positional, named = engine.dialect.create_connect_args(engine.url)
    if engine.dialect.name == "sqlite":
        return _OfSqlite(engine.dialect.connect(*positional, **named))
    options = {"autocommit": True, "connect_timeout": CONNECT_SECONDS, **_KEEPALIVES}
    return _OfPostgres(engine.dialect.connect(*positional, **{**named, **options}))


class _OfPostgres:
    def __init__(self, connection: Any) -> None:
        self.connection = connection
        connection.execute(f"LISTEN {CHANNEL}")

    def hears(self, seconds: float) -> bool:
        # All that have come are taken, so that many changes are one.
        return bool(list(self.connection.notifies(timeout=seconds, stop_after=1)))


class _OfSqlite:
    def __init__(self, connection: Any) -> None:
        self.connection, self._pause = connection, Event()
        self._last = self._number()

    def hears(self, seconds: float) -> bool:
        ends = monotonic() + seconds
        while (number := self._number()) == self._last:
            left = ends - monotonic()
            if left <= 0:
                return False
            self._pause.wait(min(left, POLL_SECONDS))
        self._last = number
        return True

    def _number(self) -> int:
        return int(self.connection.execute("PRAGMA data_version").fetchone()[0])
