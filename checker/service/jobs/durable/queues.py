"""The two queues of DBOS, as seen from outside of its workflows.

Static rules and trials wait in queues of their own, so that a new upload shows its first findings
before the trials of older ones are through.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import sqlalchemy as sa

from checker.base.record import Record
from checker.service.jobs.port import Stage

if TYPE_CHECKING:
    from dbos import DBOSClient

APPLICATION = "subt-check"
VERSION = "1"
"""Of the workflows, by hand: a worker leaves those of other versions in the queue. It only changes
when waiting checks cannot be gone on with."""
STAGES = (Stage.STATIC, Stage.TRIAL)
WAITS = "waits for its turn"
"""Said of a check that is in a queue."""
_POLLING_SECONDS = {Stage.STATIC: 0.1, Stage.TRIAL: 0.3}
"""Between two looks into a queue; people wait for the first findings, and looks cost time."""


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
