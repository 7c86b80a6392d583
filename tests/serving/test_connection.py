"""Connections that stand still, or too many of one client: they end, and all others are served."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from time import monotonic, sleep
from urllib.parse import urlsplit

import pytest
import uvicorn
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send

from checker.service.processes.child import Connection, ProxyConnection
from tests.serving.conftest import Serve

SIZE = 40_000_000
"""Bytes that no system buffers for a client that does not read."""
SLOW = 50_000
"""Bytes that a slow client takes ten times a second: fewer than the system asks for at a time."""
HELLO = b"GET /hello HTTP/1.1\r\nHost: localhost\r\n\r\n"
UNREAD = HELLO.replace(b"Host", b"Content-Length: 9999\r\nHost")
LARGE = b"GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n"


async def app(scope: Scope, receive: Receive, send: Send) -> None:
    large = Request(scope).url.path == "/large"
    await PlainTextResponse(bytes(SIZE) if large else b"hello")(scope, receive, send)


class Quick(Connection):
    head_seconds = 0.5
    reading_seconds = 1.5
    per_client = 5


class QuickFromProxy(ProxyConnection):
    head_seconds = 0.5


@contextmanager
def server(kind: type[Connection]) -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as listening:
        config = uvicorn.Config(
            app, http=kind, lifespan="off", log_config=None, timeout_graceful_shutdown=1
        )
        serving = uvicorn.Server(config)
        thread = threading.Thread(target=serving.run, args=([listening],), daemon=True)
        thread.start()
        try:
            yield listening.getsockname()[1]
        finally:
            serving.should_exit = True
            thread.join(20)


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=20)


def is_served(port: int, request: bytes = HELLO) -> bool:
    with connected(port) as connection:
        try:
            connection.sendall(request)
            return connection.recv(1_000).startswith(b"HTTP/1.1 200 OK\r\n")
        except ConnectionError:
            return False


def is_closed(connection: socket.socket) -> bool:
    """Whether the other side ends a connection, within the patience of the socket."""
    try:
        return connection.recv(1) == b""
    except ConnectionError:
        return True


@pytest.mark.parametrize("sent", [b"", b"GET /hel", HELLO[:-2]])
def test_a_head_that_does_not_come(sent: bytes) -> None:
    with server(Quick) as port, connected(port) as connection:
        connection.sendall(sent)
        assert is_closed(connection)


@pytest.mark.parametrize("before", [b"", HELLO, UNREAD])
def test_a_head_that_trickles(before: bytes) -> None:
    with server(Quick) as port, connected(port) as connection:
        connection.sendall(before)
        connection.settimeout(0.1)
        closed, ends = False, monotonic() + 20
        while not closed and monotonic() < ends:
            try:
                connection.sendall(b"G")
                closed = connection.recv(65_536) == b""
            except TimeoutError:
                continue
            except ConnectionError:
                closed = True
        assert closed


def received_from(connection: socket.socket, pause: float = 0.0) -> int:
    received = 0
    try:
        while piece := connection.recv(1_000_000):
            received += len(piece)
            sleep(pause)
    except ConnectionError:
        pass
    return received


def test_a_client_that_reads_nothing() -> None:
    with server(Quick) as port, connected(port) as connection:
        connection.sendall(LARGE)
        assert is_served(port)
        sleep(3 * Quick.reading_seconds)
        assert received_from(connection) < SIZE


def test_a_client_that_takes_its_time_gets_all() -> None:
    with server(Quick) as port, connected(port) as connection:
        connection.sendall(LARGE.replace(b"Host", b"Connection: close\r\nHost"))
        assert received_from(connection, pause=0.05) > SIZE


def test_a_client_that_takes_little_at_a_time_is_not_sent_away() -> None:
    """The system holds megabytes for it, so that for long the server is asked for no more."""
    with server(Quick) as port, connected(port) as connection:
        connection.sendall(LARGE.replace(b"Host", b"Connection: close\r\nHost"))
        ends = monotonic() + 3 * Quick.reading_seconds
        while monotonic() < ends:
            assert connection.recv(SLOW)
            sleep(0.1)
        assert received_from(connection) > SIZE / 2


def test_one_client_leaves_room_for_nobody_of_its_own() -> None:
    with server(Quick) as port, ExitStack() as stack:
        many = [stack.enter_context(connected(port)) for _ in range(Quick.per_client)]
        assert not is_served(port)
        for each in many:
            assert is_closed(each)
        assert is_served(port)


def test_the_service_has_such_connections(serve: Serve) -> None:
    port = urlsplit(serve("--workers", 0).url).port
    assert port
    with ExitStack() as stack:
        halves = [stack.enter_context(connected(port)) for _ in range(Connection.per_client)]
        for each in halves:
            each.sendall(HELLO[:-2])
        with connected(port) as one_more:
            assert is_closed(one_more)
        for each in halves:
            assert is_closed(each)
        assert is_served(port, b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")


def test_a_proxy_brings_many() -> None:
    with server(QuickFromProxy) as port, ExitStack() as stack:
        for _ in range(3 * Quick.per_client):
            stack.enter_context(connected(port))
        assert is_served(port)
