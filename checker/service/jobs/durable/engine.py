"""The workflows of DBOS: what a worker's process does with the queues."""

from __future__ import annotations

from collections.abc import Callable, Collection

import sqlalchemy as sa

from checker.service.jobs.durable.queues import APPLICATION, VERSION
from checker.service.jobs.port import Stage

Run = Callable[[str, Stage], None]
"""Does a stage of a check, told by its key; it may be called again after a crash."""


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

    # The ledger counts how often a check is begun, so DBOS need not.
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


def holders() -> set[str]:
    """Return the names of the workers that have something in hand, living or dead."""
    from dbos import DBOS

    pending = DBOS.list_workflows(status="PENDING", load_input=False, load_output=False)
    return {workflow.executor_id for workflow in pending if workflow.executor_id}


def recover(workers: Collection[str]) -> None:
    """Put back into the queues what dead workers had in hand.

    Many may do so at once: DBOS moves what is still in the hands of these workers, and nothing
    else, so that nothing is queued twice.
    """
    from dbos import DBOS

    # Internal, and what DBOS does with its own pending ones at launch. Its public call,
    # `resume_workflow`, would queue again what another worker has taken meanwhile.
    DBOS._recover_pending_workflows(sorted(workers))
