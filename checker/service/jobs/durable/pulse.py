"""Detects a PostgreSQL server that does not respond, so that requests do not wait for it."""

from __future__ import annotations

import os
import socket
from contextlib import suppress
from threading import Event, Thread
from typing import Any

import sqlalchemy as sa

from checker.service.jobs.port import JobsUnreachable

_SECONDS, _PAUSE_SECONDS = 2, 1.0
"""Greatest time of a query (the least that libpq can use to connect), and the pause after it."""
_LOOKS = 2
"""Missed looks after which a server counts as stopped: a busy one may be late once."""


def watch(engine: sa.Engine) -> None:
    """Report a database server that hangs, or is gone, to waiting callers within seconds.

    All connections end then, and until it answers again, new ones raise `JobsUnreachable`.
    DBOS itself must not use such an engine: it waits for a server to come back.

    Args:
        engine: The engine of PostgreSQL, without connections so far.
    """
    pulse = _Pulse(engine)
    sa.event.listen(engine, "do_connect", pulse.refuse)
    sa.event.listen(engine, "connect", pulse.know)
    sa.event.listen(engine, "close", pulse.forget)
    sa.event.listen(engine, "engine_disposed", pulse.end)
    Thread(target=pulse.look, daemon=True, name="pulse of the database").start()


class _Pulse:
    def __init__(self, engine: sa.Engine) -> None:
        self._engine = engine
        self._connections: dict[int, Any] = {}
        self._in_vain, self._over = 0, Event()

    def refuse(self, *_of_connection: Any) -> None:
        if self._in_vain >= _LOOKS:
            raise JobsUnreachable("the database does not answer: it stands still")

    def know(self, connection: Any, _record: Any) -> None:
        self._connections[id(connection)] = connection

    def forget(self, connection: Any, _record: Any) -> None:
        self._connections.pop(id(connection), None)

    def end(self, _engine: sa.Engine) -> None:
        self._over.set()

    def look(self) -> None:
        """Look again and again whether the server takes a new connection, until the engine ends."""
        positional, named = self._engine.dialect.create_connect_args(self._engine.url)
        named["connect_timeout"] = _SECONDS
        while not self._over.wait(_PAUSE_SECONDS):
            try:
                self._engine.dialect.connect(*positional, **named).close()
                self._in_vain = 0
            except self._engine.dialect.loaded_dbapi.Error:
                self._in_vain += 1
                if self._in_vain >= _LOOKS:
                    self._cut()

    def _cut(self) -> None:
        """End all connections: callers wait on some of them."""
        for connection in list(self._connections.values()):
            with (
                suppress(OSError, self._engine.dialect.loaded_dbapi.Error),
                socket.socket(fileno=os.dup(connection.fileno())) as its,
            ):
                its.shutdown(socket.SHUT_RDWR)
