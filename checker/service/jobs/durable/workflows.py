"""The two workflows of DBOS, and their queues: by its public interface alone.

Static rules and trials wait in queues of their own, so that a new upload shows its first findings
before the trials of older ones are through. DBOS gives each workflow to one worker, and takes up at
the launch of a worker what one of the same name had in hand. It knows no sign of life of the others
(that is for its paid Conductor): `recover` tells it whom to hold for dead.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING

import sqlalchemy as sa

from checker.base.record import Record
from checker.service.jobs.port import Stage

if TYPE_CHECKING:
    from dbos import DBOSClient

Run = Callable[[str, Stage], None]
"""Does a stage of a check, told by its key; it may be called again after a crash."""
APPLICATION = "subt-check"
VERSION = "1"
"""Of the workflows, by hand: a worker leaves those of other versions in the queue. It only changes
when waiting checks cannot be gone on with."""
STAGES = (Stage.STATIC, Stage.TRIAL)
WAITS = "waiting in the queue"
"""Said of a check that is in a queue."""
_POLLING_SECONDS = {Stage.STATIC: 0.1, Stage.TRIAL: 0.3}
"""Between two looks into a queue; people wait for the first findings, and looks cost time."""
_LOG = logging.getLogger(__name__)


def workflow_of(id: str, stage: Stage) -> str:
    """Return the id of the workflow that does a stage of a check."""
    return id if stage is Stage.STATIC else f"{id}.{stage}"


class Queues(Record):
    """Puts checks into queues."""

    client: DBOSClient

    def declare(self, trials: int | None = None) -> None:
        """Make the queues known, before there is anything in them.

        Args:
            trials: At once in each worker, of all workers of this database; None keeps what was
                said before, at first one.
        """
        for stage in STAGES:
            own = trials if stage is Stage.TRIAL else None
            self.client.register_queue(
                stage.value,
                worker_concurrency=own or 1,
                polling_interval_sec=_POLLING_SECONDS[stage],
                on_conflict="always_update" if own else "never_update",
            )

    def put(self, connection: sa.Connection, id: str, stage: Stage) -> None:
        """Queue a stage of a check, as part of a transaction."""
        self.client.enqueue_in_transaction(
            connection,
            {
                "workflow_name": stage.value,
                "queue_name": stage.value,
                "workflow_id": workflow_of(id, stage),
                "app_version": VERSION,
            },
            id,
        )

    def put_back(self, id: str, stage: Stage) -> None:
        """Queue a stage that is being worked on, where it stood before."""
        self.client.resume_workflow(workflow_of(id, stage), queue_name=stage.value)

    def cancel(self, id: str) -> None:
        """Take a check out of the queues."""
        self.client.cancel_workflows([workflow_of(id, stage) for stage in STAGES])

    def forget(self, ids: Collection[str]) -> None:
        """Delete all that DBOS knows of checks."""
        self.client.delete_workflows([workflow_of(id, stage) for id in ids for stage in STAGES])


def queues_of(engine: sa.Engine) -> Queues:
    """Return the queues of a database that is prepared."""
    from dbos import DBOSClient, DBOSPortableJSONSerializer

    client = DBOSClient(
        system_database_engine=engine,
        serializer=DBOSPortableJSONSerializer(),
        application_name=APPLICATION,
        lazy=True,
        # Who asks is told that it is unreachable.
        retry_connection_errors=False,
    )
    return Queues(client)


def launch(engine: sa.Engine, worker: str, run: Run) -> None:
    """Begin to take checks from the queues, with those that this worker had in hand before.

    Args:
        engine: Of a database that is prepared.
        worker: Name of this process; no other one has it.
        run: Does a stage.
    """
    from dbos import DBOS, DBOSPortableJSONSerializer

    DBOS(
        config={
            "name": APPLICATION,
            "system_database_engine": engine,
            "application_version": VERSION,
            "executor_id": worker,
            "serializer": DBOSPortableJSONSerializer(),
            "use_listen_notify": engine.dialect.name != "sqlite",
            "run_migrations": False,
            "log_level": "WARNING",
        }
    )

    # The table of checks counts how often one is begun, and says so on its page.
    @DBOS.workflow(name=Stage.STATIC.value, max_recovery_attempts=None)
    def static(id: str) -> None:
        run(id, Stage.STATIC)

    @DBOS.workflow(name=Stage.TRIAL.value, max_recovery_attempts=None)
    def trial(id: str) -> None:
        run(id, Stage.TRIAL)

    DBOS.launch()


def land(seconds: float) -> None:
    """Take nothing more from the queues, and wait for what is in hand.

    Args:
        seconds: At most; at least one passes.
    """
    from dbos import DBOS

    DBOS.destroy(workflow_completion_timeout_sec=max(1, round(seconds)))


def recover(worker: str, living: Callable[[], Collection[str]]) -> None:
    """Put back into the queues what dead workers have in hand; one of the living does so for all.

    Args:
        worker: Name of this process.
        living: Return the names of all that live; asked last, since some may have come just now.
    """
    from dbos import DBOS

    pending = DBOS.list_workflows(status="PENDING", load_input=False, load_output=False)
    alive = living()
    for workflow in pending if worker == min(alive) else ():
        if workflow.executor_id not in alive:
            _LOG.warning("%s died; what it had in hand waits again", workflow.executor_id)
            DBOS.resume_workflow(workflow.workflow_id, queue_name=workflow.queue_name)
