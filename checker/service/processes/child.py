"""A process of the service, which ends with the one that started it.

`python -P -m checker.service.processes.child PARENT web DESCRIPTOR PROXIES`, or
`… PARENT worker NAME`.
"""

from __future__ import annotations

import asyncio
import fcntl
import os
import signal
import socket
import sys
import termios
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

from uvicorn.protocols.http.h11_impl import H11Protocol

from checker.base.errors import CheckerError
from checker.base.files import UMASK
from checker.base.output import EXIT_CRASH, EXIT_USAGE, say_progress
from checker.base.sandbox.task import end_with_parent
from checker.base.system import tighter
from checker.service.jobs.port import JobsUnreachable
from checker.service.web.limits.rates import network_of

# Connections of the web server: idle clients, or those with too many, are disconnected.


@dataclass
class Deadline:
    """Runs a function after a while, unless cancelled."""

    do: Callable[[], None]
    _timer: asyncio.TimerHandle | None = field(default=None, repr=False)

    def set(self, seconds: float) -> None:
        """Begin to count; nothing happens if it counts already."""
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(seconds, self._reached)

    def call_off(self) -> None:
        """Count no more."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _reached(self) -> None:
        self._timer = None
        self.do()


class Connection(H11Protocol):
    """HTTP/1.1 as the server implements it, with time limits.

    The server waits for ever for the rest of a request's head, and for a client that does not read
    its answer. As many connections as it takes at once would be enough to shut everybody out.

    Attributes:
        head_seconds: The time that the head of a request may take.
        reading_seconds: The time that a client may leave an answer unread.
        per_client: Connections of one address or IPv6 network; 0 for any number.
        network: Whence it comes, as `checker.service.web.limits.rates.network_of` states it.
    """

    head_seconds = 10.0
    reading_seconds = 60.0
    per_client = 500
    network = ""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait for a request."""
        super().connection_made(transport)
        self.network = network_of(self.client[0]) if self.client else ""
        self._head, self._reader = Deadline(self._give_up), Deadline(self._look_at_reader)
        if self.per_client and self._is_one_too_many():
            transport.abort()
        else:
            self._head.set(self.head_seconds)

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._head.call_off()
        self._reader.call_off()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take what comes; only a whole head ends the wait for it."""
        super().data_received(data)
        if self._answers():
            self._head.call_off()
        elif not self.transport.is_closing():
            self._head.set(self.head_seconds)

    def pause_writing(self) -> None:
        """Begin to wait for the reader."""
        super().pause_writing()
        self._unread = self._waiting()
        self._reader.set(self.reading_seconds)

    def resume_writing(self) -> None:
        """Continue: the reader has read."""
        super().resume_writing()
        self._reader.call_off()

    def _give_up(self) -> None:
        if not self._answers():
            self.transport.abort()

    def _look_at_reader(self) -> None:
        unread, self._unread = self._unread, self._waiting()
        if self._unread < unread:
            self._reader.set(self.reading_seconds)
        else:
            self.transport.abort()

    def _waiting(self) -> int:
        """Return the bytes that the client has not taken: megabytes of them the system holds."""
        held = 0
        with suppress(OSError):  # of a socket, it is what is not acknowledged (SIOCOUTQ, tcp(7))
            answer = fcntl.ioctl(
                self.transport.get_extra_info("socket").fileno(), termios.TIOCOUTQ, bytes(4)
            )
            held = int.from_bytes(answer, sys.byteorder)
        return self.transport.get_write_buffer_size() + held

    def _answers(self) -> bool:
        """Return whether a request is being answered."""
        return self.cycle is not None and not self.cycle.response_complete

    def _is_one_too_many(self) -> bool:
        peers = (
            connection for connection in self.connections if isinstance(connection, Connection)
        )
        return sum(peer.network == self.network for peer in peers) > self.per_client


class ProxyConnection(Connection):
    """The same from a proxy, which represents many clients."""

    per_client = 0


_CONNECTIONS = 1_000
"""Connections at once; further ones get the answer that the service is busy."""
_OPEN_FILES = 4 * _CONNECTIONS
_CLOSING_SECONDS = 5
"""Time for running answers when the server stops; streams of events are cut off then."""


def web(descriptor: int, proxies: str) -> None:
    """Serve pages and API until SIGTERM.

    Args:
        descriptor: The descriptor of the socket to listen at.
        proxies: Addresses and networks whose word on their clients counts; empty for none.
    """
    import uvicorn

    from checker.service.web.app import app_from_environment

    _allow_open_files()
    config = uvicorn.Config(
        app_from_environment(),  # it asks the database, which an event loop must not wait for
        http=ProxyConnection if proxies else Connection,
        ws="none",
        log_config=None,
        access_log=False,
        server_header=False,
        proxy_headers=bool(proxies),
        forwarded_allow_ips=proxies,
        limit_concurrency=_CONNECTIONS,
        timeout_graceful_shutdown=_CLOSING_SECONDS,
    )
    uvicorn.Server(config).run([socket.socket(fileno=descriptor)])


def _allow_open_files() -> None:
    """Raise the limit of open files for all connections: many systems start with 1024."""
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    allowed = tighter(hard, _OPEN_FILES)
    if soft != resource.RLIM_INFINITY and soft < allowed:
        resource.setrlimit(resource.RLIMIT_NOFILE, (allowed, hard))


def worker(name: str) -> None:
    """Take checks from the queues until SIGTERM; see `checker.service.jobs.durable.worker`."""
    from checker.service.jobs.durable.database import database_url
    from checker.service.jobs.durable.worker import WorkerOptions, work
    from checker.service.store.store import open_store

    work(WorkerOptions(database_url(), open_store(), name))


def main(arguments: Sequence[str]) -> int:
    """Run the process that the arguments name."""
    parent, kind, *rest = arguments
    end_with_parent()
    os.umask(UMASK)  # for its own children and their libraries, too
    if os.getppid() != int(parent):  # it ended before this one could ask to end with it
        return EXIT_CRASH
    try:
        if kind == "web":
            web(int(rest[0]), rest[1])
        else:
            worker(rest[0])
    except CheckerError as error:
        say_progress(f"subt-check: {error}")
        return EXIT_USAGE
    except JobsUnreachable as error:
        say_progress(f"subt-check: {error}{_database()}")
        return EXIT_CRASH
    return 0


def _database() -> str:
    """Return the database in brackets, without its password; empty without information."""
    from checker.service.jobs.durable.database import database_url, open_database

    with suppress(JobsUnreachable):
        return f" ({open_database(database_url()).url.render_as_string(hide_password=True)})"
    return ""


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.exit(main(sys.argv[1:]))
