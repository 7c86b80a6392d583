"""Tries of the stages of a check, which are workflows of DBOS, and their rows.

A check is known by its key (`receipts.key_of_check`), and try `n` of a stage by the workflow id
`KEY.STAGE.n`. The rows of these workflows are all that is kept of a check: where it is and what
happened to it follow from them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.jobs.outcome import FAILED_INSIDE, UNFINISHED
from checker.service.jobs.port import Event, Order, Stage, State

if TYPE_CHECKING:
    from dbos import WorkflowStatus

STAGES = (Stage.STATIC, Stage.TRIAL)
"""Each has a queue and a workflow of its name."""
KNOWN = "known"
"""Name of the queue and of the workflow of checks that are over from their beginning."""
PAUSES = (1.0, 2.0, 5.0, 15.0, 30.0, 60.0, 120.0, 240.0, 300.0, 300.0, 300.0)
"""Seconds before each further try of what failed through no fault of the package, 23
minutes together. A disk that is full, or a machine that is out of memory, may need minutes. A
worker that is killed costs each of its checks a try: with ten tries, 3 of 500 checks failed while a
process was killed every three seconds on a machine under load."""
TRIES = len(PAUSES) + 1
WORKER_ENDED = "its worker process ended"
CANCELLED = "cancelled"
"""Attribute of the first workflow of a cancelled check: the time, in seconds."""
_WAITS = {
    Stage.STATIC: "waiting in the queue",
    Stage.TRIAL: "the static rules are finished; the trial is waiting in the queue",
}
_RUNS = {Stage.STATIC: "the static rules are running", Stage.TRIAL: "the trial is running"}
_WORDS_LIMIT = 2000
_END = 2 * TRIES * len(STAGES) + 1
"""Number of the last event of a check. Each try has two before it: it waits, and it runs."""


class End(Record):
    """End of a check.

    Attributes:
        stage: The final stage.
        words: The state in words.
        result: Key of the report, if there is one.
        packages: The packages, as in `State`.
    """

    stage: Stage
    words: str
    result: str = ""
    packages: tuple[Mapping[str, Any], ...] = ()


class Task(Record):
    """A try of a stage: the input of a workflow.

    Attributes:
        key: The key of the check.
        order: The order, without its sender.
        created: The time of the order, seconds since the epoch.
        expires: The time when all of the check is deleted.
        stage: `STATIC` or `TRIAL`.
        number: The number of the try, from 1; one beyond `TRIES` gives the check up.
        reason: The reason why the try before failed, the beginning of a sentence.
        result: Key of the report on the static rules, for a trial.
        packages: The packages of that report, as in `State`.
        sender: The sender in whose partition of the queue it waits.
        cost: Seconds that it takes, estimated.
        secret: Digest of the secret, in the first workflow of a check.
        end: In the workflow of a check that is over from its beginning.
    """

    key: str
    order: Order
    created: float
    expires: float
    stage: Stage = Stage.STATIC
    number: int = 1
    reason: str = ""
    result: str = ""
    packages: tuple[Mapping[str, Any], ...] = ()
    sender: str = ""
    cost: float = 0.0
    secret: str = ""
    end: End | None = None

    @property
    def id(self) -> str:
        """The id of the workflow."""
        return f"{self.key}.{self.stage}.{self.number}"

    @property
    def given_up(self) -> End | None:
        """The end of a check that was tried often enough; None before."""
        if self.number <= TRIES:
            return None
        return End(
            Stage.FAILED,
            f"{UNFINISHED}: {self.reason}; it was tried {TRIES} times",
            self.result,
            self.packages,
        )


class Row(Record):
    """A workflow as the database has it.

    Attributes:
        task: Its input.
        status: The status as DBOS calls it.
        created: The time when it was written, seconds since the epoch.
        begun: The time when a worker took it; 0 before.
        ended: The time when it ended; 0 before.
        executor: Name of the worker that took it last.
        end: The result of the check.
        cancelled: The time when the check was cancelled, in its first row; 0 if it was not.
    """

    task: Task
    status: str
    created: float
    begun: float
    ended: float
    executor: str
    end: End | None
    cancelled: float


def first_id(key: str) -> str:
    """Return the id of the first workflow of a check."""
    return f"{key}.{Stage.STATIC}.1"


def ids_of(*keys: str) -> list[str]:
    """Return the ids of all workflows that checks can have."""
    tries = [f"{stage}.{number}" for stage in STAGES for number in range(1, TRIES + 2)]
    return [f"{key}.{each}" for key in keys for each in tries]


def row_of(workflow: WorkflowStatus) -> Row:
    """Return a row whose input and output were loaded."""
    [given] = workflow.input["args"] if workflow.input else ()
    output = workflow.output or {}
    return Row(
        task := msgspec.convert(given, Task),
        workflow.status,
        _seconds(workflow.created_at),
        _seconds(workflow.dequeued_at),
        _seconds(workflow.completed_at),
        workflow.executor_id or "",
        task.end or task.given_up or (msgspec.convert(output, End) if output else None),
        (workflow.attributes or {}).get(CANCELLED, 0.0),
    )


def state_of(id: str, rows: Sequence[Row]) -> State | None:
    """Return the state of a check; None if nothing is known of it.

    Args:
        id: The id of the check.
        rows: All of the check, in the order in which its stages are tried.
    """
    events = events_of(rows)
    if not events:
        return None
    first, last = rows[0].task, rows[-1]
    found = last.end or last.task
    return State(
        id,
        first.order,
        events[-1].stage,
        events[-1].words,
        created=first.created,
        result=found.result,
        packages=found.packages,
        expires=first.expires,
    )


def events_of(rows: Sequence[Row]) -> Sequence[Event]:
    """Return what has happened to a check, in order, by its rows; nothing without the first one."""
    if not rows or rows[0].task.id != first_id(rows[0].task.key):
        return ()
    events = [event for row in rows for event in _of_try(row) if event.number < _END]
    if cancelled := rows[0].cancelled:
        return (*events, Event(_END, Stage.CANCELLED, "cancelled", cancelled))
    return (*events, *(event for event in _of_try(rows[-1]) if event.number == _END))


def _of_try(row: Row) -> Iterator[Event]:
    """Yield the events of a row; which number is whose does not depend on other rows."""
    task = row.task
    if task.end is None and task.number <= TRIES:
        number = 2 * (TRIES * STAGES.index(task.stage) + task.number) - 1
        data = {"result": task.result} if task.result else {}
        is_new = task.stage is Stage.STATIC and task.number == 1
        stage = Stage.QUEUED if is_new else task.stage
        yield Event(number, stage, _storable(_why_it_waits(task)), row.created, data)
        if row.begun:
            yield Event(number + 1, task.stage, _RUNS[task.stage], row.begun)
    if end := row.end:
        data = {"result": end.result} if end.stage is Stage.DONE else {}
        yield Event(_END, end.stage, _storable(end.words), row.ended or row.created, data)
    elif row.status in ("ERROR", "MAX_RECOVERY_ATTEMPTS_EXCEEDED"):
        yield Event(_END, Stage.FAILED, FAILED_INSIDE, row.ended)
    elif row.status == "CANCELLED":
        yield Event(_END, Stage.CANCELLED, "cancelled", row.ended)


def _why_it_waits(task: Task) -> str:
    if not task.reason:
        return _WAITS[task.stage]
    return f"starts again: {task.reason} (try {task.number} of {TRIES})"


def _storable(words: str) -> str:
    return shortened(plain(words), _WORDS_LIMIT)


def _seconds(milliseconds: int | None) -> float:
    return (milliseconds or 0) / 1e3


def in_order(rows: Sequence[Row]) -> Mapping[str, Sequence[Row]]:
    """Return the rows of each check in the order in which its stages are tried, by its key."""
    found: dict[str, list[Row]] = {}
    for row in sorted(rows, key=lambda row: (STAGES.index(row.task.stage), row.task.number)):
        found.setdefault(row.task.key, []).append(row)
    return found
