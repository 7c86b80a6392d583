"""A clerk in a process of its own: takes uploads until the web process ends."""

from __future__ import annotations

import logging
import socket
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cached_property, partial
from threading import Lock

from checker.jobs.durable.client import DurableJobs, durable_jobs
from checker.jobs.place import database_url
from checker.jobs.port import JobsUnreachable
from checker.record import record
from checker.store.place import data_folder
from checker.store.store import Store
from checker.web.clerk.port import Slip, kept
from checker.web.clerk.wire import answer_line, slip_from_line
from checker.web.config import Config, config_from
from checker.web.logs import LOGGER, log_to_stderr

_AT_ONCE = 8
"""Uploads; while the disk writes one, another one is looked at."""
_LOG = logging.getLogger(LOGGER)


@record()
class _Desk:
    """What a clerk works with."""

    store: Store
    config: Config

    def take(self, slip: Slip) -> str:
        return self.jobs.submit(kept(slip, self.store))

    @cached_property
    def jobs(self) -> DurableJobs:
        """The engine; asked for again as long as its database does not answer."""
        return durable_jobs(database_url(), self.store, self.config.retention_days)


def work(descriptor: int) -> None:
    """Take what comes.

    Args:
        descriptor: Of the socket where the web process writes; it is closed when that ends.

    Raises:
        CheckerError: A variable has a value that makes no sense, or there is no place for data.
    """
    desk = _Desk(Store(data_folder()), config_from())
    log_to_stderr()
    with suppress(JobsUnreachable):
        _ = desk.jobs
    turn = Lock()

    def answer(line: bytes) -> None:
        number, slip = slip_from_line(line)
        on_fault = partial(_LOG.exception, "an upload is not taken")
        said = answer_line(number, partial(desk.take, slip), on_fault)
        with turn:
            wire.sendall(said)

    with (
        socket.socket(fileno=descriptor) as wire,
        wire.makefile("rb") as lines,
        ThreadPoolExecutor(_AT_ONCE) as threads,
    ):
        for line in lines:
            threads.submit(answer, line)
