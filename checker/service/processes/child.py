"""A process of the service, which ends with the one that started it.

`python -P -m checker.service.processes.child PARENT web DESCRIPTOR PROXIES`,
`… PARENT clerk DESCRIPTOR` or `… PARENT worker NAME`.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
from collections.abc import Sequence

from checker.base.errors import CheckerError
from checker.base.output import EXIT_CRASH, EXIT_USAGE, say_progress
from checker.base.private_files import UMASK
from checker.base.sandbox.task import end_with_parent, tighter
from checker.service.jobs.port import JobsUnreachable

CHILD = (sys.executable, "-P", "-m", "checker.service.processes.child")
"""Starts such a process; what follows says whose child it is, and which."""
_CONNECTIONS = 1_000
"""At once; further ones are told that the service is busy."""
_OPEN_FILES = 4 * _CONNECTIONS
_CLOSING_SECONDS = 5
"""For answers that are under way when the server stops; streams of events are cut off then."""


def web(descriptor: int, proxies: str) -> None:
    """Serve pages and API until SIGTERM.

    Args:
        descriptor: Of the socket to listen at.
        proxies: Addresses and networks whose word on their clients counts; empty for none.
    """
    import uvicorn

    from checker.service.processes.connection import Connection, ProxyConnection
    from checker.service.web.clerk.process import ProcessClerk
    from checker.service.web.main import app_from_environment

    _allow_open_files()
    clerk = ProcessClerk((*CHILD, str(os.getpid()), "clerk"))
    clerk.start()
    config = uvicorn.Config(
        app_from_environment(clerk),  # it asks the database, which an event loop must not wait for
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
    """Have room for all connections and what they send: 1024 is what many systems begin with."""
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    allowed = tighter(hard, _OPEN_FILES)
    if soft != resource.RLIM_INFINITY and soft < allowed:
        resource.setrlimit(resource.RLIMIT_NOFILE, (allowed, hard))


def clerk(descriptor: int) -> None:
    """Take uploads until the web process ends; see `checker.service.web.clerk.child`."""
    from checker.service.web.clerk.child import work

    # Meant for the web process, which finishes what it has begun.
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    work(descriptor)


def worker(name: str) -> None:
    """Take checks from the queues until SIGTERM; see `checker.service.jobs.durable.worker`."""
    from checker.service.jobs.durable.worker import WorkerOptions, work
    from checker.service.jobs.place import database_url
    from checker.service.store.place import data_folder
    from checker.service.store.store import Store

    work(WorkerOptions(database_url(), Store(data_folder()), name))


def main(arguments: Sequence[str]) -> int:
    """Be the process that the arguments ask for."""
    parent, kind, *rest = arguments
    end_with_parent()
    os.umask(UMASK)  # for its own children and their libraries, too
    if os.getppid() != int(parent):  # it ended before this one could ask to end with it
        return EXIT_CRASH
    try:
        if kind == "web":
            web(int(rest[0]), rest[1])
        elif kind == "clerk":
            clerk(int(rest[0]))
        else:
            worker(rest[0])
    except CheckerError as error:
        say_progress(f"subt-check: {error}")
        return EXIT_USAGE
    except JobsUnreachable as error:
        say_progress(f"subt-check: {error}")
        return EXIT_CRASH
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.exit(main(sys.argv[1:]))
