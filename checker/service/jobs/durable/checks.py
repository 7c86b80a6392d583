"""Checks as rows of DBOS: ordered, tried again, looked up, cancelled and forgotten.

There is no second table with the state of a check, which could differ from DBOS. Every
call may be made twice, by several processes at once: a workflow id is entered once.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from datetime import UTC, datetime
from threading import Lock
from time import time
from typing import TYPE_CHECKING

import sqlalchemy as sa
from msgspec import field, to_builtins
from msgspec.structs import replace

from checker.base.record import Record
from checker.service.jobs.durable.tasks import (
    CANCELLED,
    KNOWN,
    PAUSES,
    STAGES,
    TRIES,
    WORKER_ENDED,
    Row,
    Task,
    first_id,
    ids_of,
    in_order,
    row_of,
)

if TYPE_CHECKING:
    from dbos import DBOSClient, EnqueueOptions, WorkflowStatus

_PAGE = 500
"""Rows that are read at a time."""
_WAITING = ["ENQUEUED", "DELAYED"]
_QUEUES = [stage.value for stage in STAGES]


class Checks(Record):
    """The checks in a database.

    Attributes:
        engine: The engine of the database.
        client: Queries DBOS's tables there.
        pauses: Seconds before each further try.
    """

    engine: sa.Engine
    client: DBOSClient
    pauses: Sequence[float] = PAUSES
    _writing: Lock = field(default_factory=Lock)

    def enter(self, task: Task, pause: float = 0.0) -> None:
        """Put a task into the queue of its stage, unless it was entered before.

        Args:
            task: The task.
            pause: Seconds before it may be taken.
        """
        from dbos import error

        queue = KNOWN if task.end else task.stage.value
        options: EnqueueOptions = {
            "workflow_name": queue,
            "queue_name": queue,
            "workflow_id": task.id,
        }
        if pause:
            options["delay_seconds"] = pause
        if not task.end:
            # Shorter tasks of a sender are first.
            options |= {"queue_partition_key": task.sender, "priority": max(1, round(task.cost))}
        with (
            suppress(error.DBOSConflictingWorkflowError),
            self._turn,
            self.engine.begin() as connection,
        ):
            self.client.enqueue_in_transaction(connection, options, to_builtins(task))

    def retry(self, task: Task, reason: str) -> None:
        """Retry a task later, or give it up."""
        pause = 0.0 if task.number >= TRIES else self.pauses[task.number - 1]
        self.enter(replace(task, number=task.number + 1, reason=reason), pause)

    def hand_back(self, task: Task) -> None:
        """Put a running task back into the queue, without counting a try."""
        self.client.resume_workflow(task.id, queue_name=task.stage.value)

    def recover(self, is_dead: Callable[[str], bool]) -> Sequence[str]:
        """Retry the tasks of workers that ended, and return the workers' names.

        Of two workers that do so at once, or one that crashes meanwhile, no task is lost.
        """
        found = self.client.list_workflows(status="PENDING", queue_name=[*_QUEUES, KNOWN])
        lost = [each for each in found if is_dead(each.executor_id or "")]
        for each in lost:
            if each.queue_name == KNOWN:
                self.client.resume_workflow(each.workflow_id, queue_name=KNOWN)
                continue
            self.retry(row_of(each).task, WORKER_ENDED)
            self.client.cancel_workflow(each.workflow_id)
        return sorted({each.executor_id or "" for each in lost})

    def is_wanted(self, task: Task) -> bool:
        """Return whether a running task is still wanted, and belongs to the worker that runs it."""
        ids = [task.id, first_id(task.key)]
        found = self.client.list_workflows(workflow_ids=ids, load_input=False, load_output=False)
        rows = {row.workflow_id: row for row in found}
        if not rows.keys() >= {*ids}:
            return False
        is_cancelled = CANCELLED in (rows[first_id(task.key)].attributes or {})
        return rows[task.id].status == "PENDING" and not is_cancelled

    def rows(self, keys: Iterable[str]) -> Mapping[str, Sequence[Row]]:
        """Return the rows of checks in the order of their tries, by the keys of those known."""
        ids = ids_of(*keys)
        return in_order([*map(row_of, self.client.list_workflows(workflow_ids=ids))] if ids else [])

    def all_rows(self) -> Iterator[Row]:
        """Yield the rows of all checks; some may come twice."""
        since, limit = "", _PAGE
        while True:
            page = self.client.list_workflows(
                start_time=since or None, limit=limit, name=[*_QUEUES, KNOWN]
            )
            yield from map(row_of, page)
            if len(page) < limit:
                return
            # Rows come by the time at which they were written; those of this second come again.
            last = datetime.fromtimestamp((page[-1].created_at or 0) // 1000, UTC).isoformat()
            since, limit = last, 2 * limit if last == since else _PAGE

    def cancel(self, key: str) -> None:
        """End a check: nothing of it is begun any more, and what runs is stopped soon."""
        first = first_id(key)
        self.client.update_workflow_attributes(first, {CANCELLED: round(time(), 3)})
        self.client.cancel_workflows(ids_of(key))

    def forget(self, keys: Iterable[str]) -> None:
        """Delete checks in any state; a worker that runs one loses it."""
        ids = ids_of(*keys)
        self.client.cancel_workflows(ids)
        self.client.delete_workflows(ids)

    def waiting(self) -> Mapping[str, int]:
        """Return how many tasks wait, by stage, and how many run by ``""``."""
        counted = Counter(
            (each.queue_name or "") if each.status in _WAITING else ""
            for each in self._queued([*_WAITING, "PENDING"], _QUEUES)
        )
        return {name: counted[name] for name in (*_QUEUES, "")}

    def count_ahead(self, task: Task) -> int:
        """Return how many tasks probably come before one that waits; 0 if it does not wait.

        Whose turn is next among senders is drawn, with shorter tasks first within each: so many of
        each other sender come before a task as its own, and one.
        """
        waiting = self._queued(["ENQUEUED"], [task.stage.value])
        own = next((each for each in waiting if each.workflow_id == task.id), None)
        if own is None:
            return 0
        of_senders: dict[str | None, list[WorkflowStatus]] = {}
        for each in sorted(waiting, key=lambda each: each.priority or 0):
            of_senders.setdefault(each.queue_partition_key, []).append(each)
        place = of_senders.pop(own.queue_partition_key).index(own)
        return place + sum(min(len(those), place + 1) for those in of_senders.values())

    def _queued(self, status: list[str], queues: list[str]) -> list[WorkflowStatus]:
        return self.client.list_workflows(
            status=status, queue_name=queues, load_input=False, load_output=False
        )

    @property
    def _turn(self) -> AbstractContextManager[object]:
        """A turn of this process to write into SQLite, which has writers try again after a while.

        Among many, some would wait for seconds.
        """
        return self._writing if self.engine.dialect.name == "sqlite" else nullcontext()
