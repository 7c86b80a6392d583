"""A worker: a process that takes checks from the queues until it is told to stop."""

from __future__ import annotations

import logging
import os
import secrets
import signal
import socket
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import closing, suppress
from time import monotonic

from msgspec import field

from checker.base.record import Record
from checker.base.sandbox.layers import Layer, hides_files
from checker.base.signals import on_requests_to_end
from checker.engine.report_cache import program_parts
from checker.service.jobs.children import Children
from checker.service.jobs.durable.changes import Changes
from checker.service.jobs.durable.checks import PAUSES, Checks
from checker.service.jobs.durable.database import open_database, prepare, reachable
from checker.service.jobs.durable.dispatcher import Dispatcher
from checker.service.jobs.durable.stages import Retention, Stages
from checker.service.jobs.durable.steps import Taker
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import SILENCE_SECONDS, JobsUnreachable, Stage
from checker.service.jobs.sandbox import layers_of_checks
from checker.service.store.life import forget, living, the_dead
from checker.service.store.store import Store

_LOG = logging.getLogger(__name__)
_KNOWN_SILENCES = 60
"""A dead worker stays known for so many times the silence, for those who look at it."""
_LANDING_SECONDS = 10.0
"""For the children of what is handed back to end, and for the database to hear of it."""


def _some_name() -> str:
    return f"worker-{secrets.token_hex(4)}"


class WorkerOptions(Record):
    """How a worker works.

    Attributes:
        database_url: As `checker.service.jobs.durable.database.database_url` says it.
        store: Uploads and results.
        name: Of this worker, of letters, digits and `-`; no other one has it at the same time. One
            that is started again under its old name takes up at once what it had in hand.
        trials: At once.
        host: Machine or container, as workers on it call it.
        grace_seconds: To finish what is in hand after the signal to stop; then it is handed back.
        beat_seconds: Between two signs of life.
        silence_seconds: After which other workers take this one for dead.
        cleaning_seconds: Between two rounds that delete what has had its time.
        unused_seconds: That files stay which no check refers to.
        pauses: Seconds before each further try of what came to nothing (see `checks.PAUSES`).
        ahead: Whether the process of the next check is started before there is one; it has 0.1 GB.
    """

    database_url: str
    store: Store
    name: str = field(default_factory=_some_name)
    trials: int = 1
    host: str = field(default_factory=socket.gethostname)
    grace_seconds: float = 20.0
    beat_seconds: float = 10.0
    silence_seconds: float = SILENCE_SECONDS
    cleaning_seconds: float = 3600.0
    unused_seconds: float = 3600.0
    pauses: Sequence[float] = PAUSES
    ahead: bool = True


def run_worker(stop: threading.Event, options: WorkerOptions) -> None:
    """Take checks from the queues until `stop` is set, then finish or hand back what is in hand.

    Threads of what was handed back may outlive it: end the process by `os._exit`, as `work` does.

    Raises:
        JobsUnreachable: The database does not answer at the start.
    """
    engine = open_database(options.database_url)
    prepare(engine)
    layers = layers_of_checks(options.store)
    _tell_of(layers)
    workers, checks = Workers(engine, layers, options.host), Checks(engine, options.pauses)
    taker = Taker(options.name, options.host)
    children = Children(options.store, options.ahead)
    stages = Stages(checks, options.store, taker, children)
    retention = Retention(engine, options.store, options.unused_seconds)
    # What every result depends on takes 0.1 s to look through: now no upload waits for it.
    program_parts()
    places = {Stage.STATIC: 1, Stage.TRIAL: options.trials}
    dispatcher = Dispatcher(checks, taker, places, stages.run)
    with living(options.store.workers, options.name):
        _begin(Deaths(checks, workers, options), retention, stop)
        children.get_ready()
        _LOG.info("%s is waiting for checks", options.name)
        with closing(Changes(engine)) as changes:
            dispatcher.take_until(stop, changes)
        _LOG.info("%s stops; it has %g s to finish its checks", taker.name, options.grace_seconds)
        if not dispatcher.wait(options.grace_seconds):
            stages.hand_back.set()
            dispatcher.wait(_LANDING_SECONDS)
        children.close()
        with suppress(JobsUnreachable), reachable():
            workers.strike(options.name)


def _begin(deaths: Deaths, retention: Retention, stop: threading.Event) -> None:
    """Take over what is left from before, and begin what a worker does all the time.

    Raises:
        JobsUnreachable: The database does not answer.
    """
    options = deaths.options
    with reachable():
        deaths.take_over()
    _in_background(deaths.look, options.beat_seconds, threading.Event())
    _in_background(retention.delete, options.cleaning_seconds, stop)


class Deaths:
    """Shows that this worker lives, and sees to what dead ones had in hand."""

    def __init__(self, checks: Checks, workers: Workers, options: WorkerOptions) -> None:
        """Begin to count the time without a gap in this worker's own signs of life."""
        self._checks, self._workers, self.options = checks, workers, options
        self._last = self._since = monotonic()

    def look(self) -> None:
        """Show a sign of life, and have what is in the hands of the dead wait again.

        When the database was away, or this machine slept, all workers have been silent: the first
        one that is back must not take the others for dead.
        """
        silence, name = self.options.silence_seconds, self.options.name
        self._workers.beat(name)
        now = monotonic()
        if now - self._last > silence / 2.0:
            self._since = now
        self._last = now
        living = self._workers.living(silence)
        steady = now - self._since >= silence
        self._recover(lambda other: other != name and steady and other not in living)
        self._workers.strike_silent(_KNOWN_SILENCES * silence)

    def take_over(self) -> None:
        """Show the first sign of life; what this worker had in hand before it died waits again."""
        self._workers.beat(self.options.name)
        self._recover(lambda other: other == self.options.name)

    def _recover(self, is_silent: Callable[[str], bool]) -> None:
        folder = self.options.store.workers
        dead = the_dead(folder)
        for name in self._checks.recover(lambda name: name in dead or is_silent(name)):
            _LOG.warning("%s died; what it had in hand waits again", name)
        for name in dead:
            forget(folder, name)


def _tell_of(layers: Sequence[Layer]) -> None:
    held = ", ".join(f"{layer.name} ({layer.words})" for layer in layers if layer.held)
    _LOG.info("layers of the sandbox: %s", held or "none")
    if not hides_files(layers):
        _LOG.warning(
            "no sandbox layer hides files: an upload that takes control of a check can read all "
            "files of this user"
        )


def work(options: WorkerOptions) -> None:
    """Be a worker until SIGTERM or SIGINT; the process ends with it. A second signal ends at once.

    Raises:
        JobsUnreachable: The database does not answer at the start.
    """
    logging.basicConfig(
        level=logging.INFO,
        stream=sys.stderr,
        format="%(asctime)s %(levelname)s %(name)s: %(message)s",
    )
    stop = threading.Event()
    # Whoever started it may have it ignore the terminal's Ctrl-C, and stop it in time.
    both = (signal.SIGTERM, signal.SIGINT)
    heeded = [number for number in both if signal.getsignal(number) is not signal.SIG_IGN]
    on_requests_to_end(heeded, stop.set, lambda: os._exit(1))
    run_worker(stop, options)
    logging.shutdown()
    os._exit(0)


def _in_background(do: Callable[[], None], every_seconds: float, stop: threading.Event) -> None:
    """Do something at once and again and again, come what may, until told to stop."""

    def repeat() -> None:
        while True:
            try:
                with reachable():
                    do()
            except JobsUnreachable as error:
                _LOG.warning("%s", error)
            except Exception:  # noqa: BLE001 - a worker that shows no sign of life is taken for dead
                _LOG.exception("%s fails", do.__qualname__)
            if stop.wait(every_seconds):
                return

    threading.Thread(target=repeat, daemon=True, name=do.__qualname__).start()
