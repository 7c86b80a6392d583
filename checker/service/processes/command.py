"""Commands `serve` and `worker`."""

from __future__ import annotations

import argparse
import os
import secrets
import signal
import socket
import sys
import threading
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from checker.base.errors import CheckerError, Unreachable
from checker.base.files import UMASK
from checker.base.output import EXIT_CLEAN, EXIT_CRASH, say_progress, show
from checker.base.sandbox.launcher import module_path
from checker.base.signals import on_requests_to_end
from checker.service.exposure import address_of, listening, risk_of, warning_of
from checker.service.processes.supervisor import Pace, Process, keep_running, stop_all
from checker.service.store.place import choose, data_folder

if TYPE_CHECKING:
    from checker.service.store.store import Store

CHILD = (sys.executable, "-P", "-m", f"{__package__}.child")
"""Starts a process of the service; what follows states whose child it is, and which."""
_MOST_WORKERS = 2
"""Default number of workers: a trial keeps a core busy."""


def serve(options: argparse.Namespace, pace: Pace | None = None) -> int:
    """Run the web server and its workers until SIGTERM or SIGINT; a second one ends all at once.

    Workers are started when the web server answers: to load what they need takes several seconds of
    processor time, for which the first uploads would wait. A database that does not answer is then
    stated by the web server alone.

    Raises:
        CheckerError: The arguments make no sense.
    """
    store = _data_made(options)
    environment = _environment(options)
    with listening(options.host, options.port) as bound:
        for warning in filter(None, _warnings(bound, environment, store)):
            _say(warning)
        stop, at_once = _signals()
        processes = _processes(options, bound, environment)
        processes[0].start()
        try:
            return _served(bound, processes, stop, at_once, pace or Pace())
        finally:
            bound.close()
            stop_all(processes, at_once, Pace(grace=0.0))


def worker(options: argparse.Namespace) -> int:
    """Be a worker of a service until SIGTERM or SIGINT; see `jobs.durable.worker.work`.

    Raises:
        Unreachable: The database does not answer.
    """
    from checker.service.jobs.durable.database import database_url
    from checker.service.jobs.durable.worker import WorkerOptions, work
    from checker.service.jobs.port import JobsUnreachable

    os.umask(UMASK)  # for its children and their libraries, too
    store = _data_made(options)
    own: dict[str, Any] = {"name": options.name} if options.name else {}
    own |= {"trials": options.jobs} if options.jobs else {}
    try:
        work(WorkerOptions(database_url(), store, **own))
    except JobsUnreachable as error:
        raise Unreachable(str(error)) from None
    return EXIT_CLEAN


def _environment(options: argparse.Namespace) -> Mapping[str, str]:
    """Return the variables of the processes: those of here, and what the options state."""
    variables = {"SUBT_CHECK_BASE_URL": options.base_url} if options.base_url else {}
    variables |= {"SUBT_CHECK_PUBLIC": "1"} if options.public else {}
    variables |= {"SUBT_CHECK_WITHOUT_SANDBOX": "1"} if options.without_sandbox else {}
    return {**os.environ, "PYTHONPATH": module_path(), **variables}


def _warnings(bound: socket.socket, environment: Mapping[str, str], store: Store) -> Iterator[str]:
    """Yield the warnings about the permission to upload, and its risks.

    Raises:
        CheckerError: It is more than is allowed.
    """
    from checker.service.jobs.sandbox import layers_of_checks

    yield warning_of(bound, environment)
    # Without workers as well: the indexes of archives are read here.
    yield risk_of(environment, lambda: layers_of_checks(store))


def _data_made(options: argparse.Namespace) -> Store:
    """Return the store, created privately if needed; children find it in the environment.

    Raises:
        CheckerError: It cannot be made or written.
    """
    from checker.service.store.store import open_store

    choose(options.data, options.store)
    folder = data_folder()
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        problem = "" if os.access(folder, os.W_OK | os.X_OK) else "permission denied"
    except OSError as error:
        problem = error.strerror or "it cannot be created"
    if problem:
        raise CheckerError(
            f"{folder} cannot be used for the service's data ({problem}); choose another with "
            "--data"
        )
    store = open_store()
    store.tighten()
    return store


def _processes(
    options: argparse.Namespace,
    bound: socket.socket,
    environment: Mapping[str, str],
) -> Sequence[Process]:
    number = options.workers
    if number is None:
        number = min(_MOST_WORKERS, os.cpu_count() or 1)
    child = (*CHILD, str(os.getpid()))
    descriptor, group = bound.fileno(), secrets.token_hex(4)
    web = (*child, "web", str(descriptor), options.behind_proxy)
    workers = [
        Process(f"worker {n}", (*child, "worker", f"worker-{group}-{n}"), environment)
        for n in range(1, number + 1)
    ]
    return [Process("the web server", web, environment, (descriptor,)), *workers]


def _signals() -> tuple[threading.Event, threading.Event]:
    """Return the events that the first and the second request to end set."""
    stop, at_once = threading.Event(), threading.Event()
    on_requests_to_end((signal.SIGTERM, signal.SIGINT), stop.set, at_once.set)
    return stop, at_once


def _served(
    bound: socket.socket,
    processes: Sequence[Process],
    stop: threading.Event,
    at_once: threading.Event,
    pace: Pace,
) -> int:
    web = processes[0]
    while not (_answers(bound) or stop.is_set()):
        if not web.is_running:
            return web.exit_code or EXIT_CRASH  # it has said why
        stop.wait(0.05)
    if not stop.is_set():
        show(f"the service runs at {address_of(bound)}\n")
        keep_running(processes, stop, pace, _say)
    bound.close()
    _say("stops; a second signal ends it immediately")
    return EXIT_CLEAN if stop_all(processes, at_once, pace) else EXIT_CRASH


def _answers(bound: socket.socket) -> bool:
    """Return whether a process listens on the socket."""
    return bool(bound.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN))


def _say(words: str) -> None:
    say_progress(f"subt-check: {words}")
