"""A worker: a process that takes checks from the queues until it is stopped."""

from __future__ import annotations

import logging
import os
import secrets
import signal
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.sandbox.layers import Layer, hides_files
from checker.base.signals import on_requests_to_end
from checker.engine.report_cache import program_parts
from checker.service.jobs.children import Children
from checker.service.jobs.durable.database import APPLICATION, SCHEMA, open_database, reachable
from checker.service.jobs.durable.deaths import Deaths
from checker.service.jobs.durable.prepare import prepare_database
from checker.service.jobs.durable.retention import UNUSED_SECONDS, Retention
from checker.service.jobs.durable.stages import Stages
from checker.service.jobs.durable.tasks import KNOWN, PAUSES, STAGES
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import SILENCE_SECONDS, JobsUnreachable
from checker.service.jobs.sandbox import layers_of_checks
from checker.service.logs import log_to_stderr
from checker.service.store.locks import hold_lock
from checker.service.store.store import Store

if TYPE_CHECKING:
    import sqlalchemy as sa

_LOG = logging.getLogger(__name__)
_LANDING_SECONDS = 10
"""For the children of what is handed back to end, and for the database to hear of it."""
_DRAIN_SECONDS = 3600.0
"""For a worker that is drained to finish its checks; each has its own limits, of minutes."""
_VERSION = "1"
"""The version of the workflows for DBOS: workers do not take tasks of another version."""


class WorkerOptions(Record):
    """Settings of a worker.

    Attributes:
        database_url: The URL as `checker.service.jobs.durable.database.database_url` states it.
        store: Uploads and results.
        name: The name of this worker, of letters, digits and `-`; the process adds what no other
            one has.
        trials: The number of trials at once.
        grace_seconds: The time to finish running tasks after the signal to stop; then they are
            returned.
        beat_seconds: The time between two signs of life.
        silence_seconds: After which other workers regard this one as dead.
        cleaning_seconds: The time between two rounds that delete expired files.
        unused_seconds: The time that files without a check are kept.
        pauses: Seconds before each further try of a task that failed (see `tasks.PAUSES`).
        ahead: Whether the process of the next check is started before there is one; it uses 0.1 GB.
    """

    database_url: str
    store: Store
    name: str = "worker"
    trials: int = 1
    grace_seconds: float = 20.0
    beat_seconds: float = 2.0
    silence_seconds: float = SILENCE_SECONDS
    cleaning_seconds: float = 3600.0
    unused_seconds: float = UNUSED_SECONDS
    pauses: Sequence[float] = PAUSES
    ahead: bool = True


def run_worker(stop: threading.Event, options: WorkerOptions) -> None:
    """Take checks from the queues until `stop` is set, then finish or return running tasks.

    A worker that is drained ends too: it finishes its running tasks.

    Threads of what was handed back may outlive it: end the process by `os._exit`, as `work` does.

    Raises:
        JobsUnreachable: The database does not answer at the start.
    """
    engine = open_database(options.database_url)
    checks = replace(prepare_database(engine, options.trials), pauses=options.pauses)
    layers = layers_of_checks(options.store)
    _tell_of(layers)
    # DBOS would resume tasks of a worker of the same name by itself, without counting a try.
    name = f"{options.name}-{secrets.token_hex(4)}"
    workers = Workers(engine, layers)
    children = Children(options.store, options.ahead)
    stages = Stages(checks, options.store, children)
    retention = Retention(checks, options.store, options.unused_seconds)
    # What every result depends on takes 0.1 s to look through: now no upload waits for it.
    program_parts()
    with hold_lock(options.store.workers, name):
        deaths = Deaths(checks, workers, options.store, name, options.silence_seconds)
        with reachable():
            deaths.look()
        _in_background(deaths.look, options.beat_seconds, threading.Event())
        _in_background(retention.delete, options.cleaning_seconds, stop)
        children.get_ready()
        end = _take_tasks(engine, name, stages.run)
        _LOG.info("%s is waiting for checks", name)
        while not (stop.wait(options.beat_seconds) or deaths.drained.is_set()):
            pass
        grace = options.grace_seconds if stop.is_set() else _DRAIN_SECONDS
        _LOG.info("%s stops; it has %g s to finish its checks", name, grace)
        _once(stop, options.grace_seconds, stages.hand_back.set)
        end(grace + _LANDING_SECONDS)
        children.close()
        with suppress(JobsUnreachable), reachable():
            workers.strike(name)


def _take_tasks(
    engine: sa.Engine, name: str, run: Callable[[dict[str, Any]], dict[str, Any]]
) -> Callable[[float], None]:
    """Run tasks from the queues by DBOS; return what ends it, given seconds for running ones."""
    from dbos import DBOS, DBOSPortableJSONSerializer

    for workflow in (*(stage.value for stage in STAGES), KNOWN):
        DBOS.workflow(name=workflow)(_function(run))
    DBOS(
        config={
            "name": APPLICATION,
            "system_database_engine": engine,
            "dbos_system_schema": SCHEMA,
            "serializer": DBOSPortableJSONSerializer(),
            "executor_id": name,
            "application_version": _VERSION,
            "use_listen_notify": False,
            "run_migrations": False,
            "log_level": "WARNING",
        }
    )
    DBOS.launch()
    return lambda seconds: DBOS.destroy(workflow_completion_timeout_sec=round(seconds))


def _function(run: Callable[[dict[str, Any]], dict[str, Any]]) -> Callable[..., dict[str, Any]]:
    """Return a separate function for each workflow: DBOS writes the name on it."""

    def workflow(task: dict[str, Any]) -> dict[str, Any]:
        return run(task)

    return workflow


def _tell_of(layers: Sequence[Layer]) -> None:
    held = ", ".join(f"{layer.name} ({layer.words})" for layer in layers if layer.held)
    _LOG.info("layers of the sandbox: %s", held or "none")
    if not hides_files(layers):
        _LOG.warning(
            "no sandbox layer hides files: an upload that takes control of a check can read all "
            "files of this user"
        )


def work(options: WorkerOptions) -> None:
    """Be a worker until SIGTERM or SIGINT, or until it is drained; the process ends with it.

    A second signal ends it at once.

    Raises:
        JobsUnreachable: The database does not answer at the start.
    """
    log_to_stderr()
    stop = threading.Event()
    # Its parent may make it ignore the terminal's Ctrl-C, and stop it in time.
    both = (signal.SIGTERM, signal.SIGINT)
    heeded = [number for number in both if signal.getsignal(number) is not signal.SIG_IGN]
    on_requests_to_end(heeded, stop.set, lambda: os._exit(1))
    run_worker(stop, options)
    logging.shutdown()
    os._exit(0)


def _once(ended: threading.Event, seconds: float, do: Callable[[], None]) -> None:
    """Do something so long after an event."""

    def wait() -> None:
        ended.wait()
        time.sleep(seconds)
        do()

    threading.Thread(target=wait, daemon=True).start()


def _in_background(do: Callable[[], object], every_seconds: float, stop: threading.Event) -> None:
    """Run a function repeatedly, whatever it raises, until stopped."""

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
