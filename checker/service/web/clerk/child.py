"""A clerk in a process of its own: takes uploads until the web process ends."""

from __future__ import annotations

import logging
import socket
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cached_property, partial
from threading import Lock

from msgspec import field

from checker.base.record import Record
from checker.engine.report_cache import program_parts
from checker.service.jobs.durable.client import DurableJobs, durable_jobs
from checker.service.jobs.place import database_url
from checker.service.jobs.port import JobsUnreachable
from checker.service.store.place import data_folder
from checker.service.store.store import Store
from checker.service.web.clerk.indexes import Indexes
from checker.service.web.clerk.port import Slip, accepted, looked_at
from checker.service.web.clerk.wire import answer_line, slip_from_line
from checker.service.web.config import Config, config_from
from checker.service.web.logs import LOGGER, log_to_stderr

_AT_ONCE = 16
"""Uploads; while the disk writes some, another one is looked at."""
_PATIENCE = 0.1
"""Seconds that one waits until another one is looked at: most take 2 ms, some archives seconds."""
_LOG = logging.getLogger(LOGGER)


class _Desk(Record, dict=True):
    """What a clerk works with."""

    store: Store
    config: Config
    turn: Lock = field(default_factory=Lock)
    indexes: Indexes = field(default_factory=Indexes)

    def take(self, slip: Slip) -> str:
        # Threads that all want the interpreter spend as much time again on passing it around.
        has_turn = self.turn.acquire(timeout=_PATIENCE)
        try:
            order = looked_at(slip, self.indexes)
        finally:
            if has_turn:
                self.turn.release()
        return accepted(slip, order, self.store, self.jobs)

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
    with suppress(OSError):
        desk.indexes.start()
    with suppress(JobsUnreachable):
        desk.jobs.alive()
    # Each result is that of a program; to look through all of this one takes as long as 20 uploads.
    program_parts()
    answering = Lock()

    def answer(line: bytes) -> None:
        number, slip = slip_from_line(line)
        on_fault = partial(_LOG.exception, "an upload is not taken")
        said = answer_line(number, partial(desk.take, slip), on_fault)
        with answering:
            wire.sendall(said)

    with (
        socket.socket(fileno=descriptor) as wire,
        wire.makefile("rb") as lines,
        ThreadPoolExecutor(_AT_ONCE) as threads,
    ):
        for line in lines:
            threads.submit(answer, line)
