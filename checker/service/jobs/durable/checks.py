"""What DBOS cannot know of a check: what was asked for, how far it is, and what was told of it.

Every change is one transaction that holds only if the check is where it was thought to be: what a
worker says that was taken for dead and comes back is not written. Checks go by their keys here and
in all that follows (`checker.service.jobs.durable.tables`): a copy of the table opens no report.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cached_property
from threading import Lock
from typing import Any

import sqlalchemy as sa
from msgspec import field

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.jobs.durable.changes import tell
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.tables import CHECKS, EVENTS
from checker.service.jobs.durable.workflows import WAITS
from checker.service.jobs.outcome import UNFINISHED
from checker.service.jobs.port import Event, Order, Stage, State

WORKERS_LOST = 3
"""A check that so many workers died of is not given to another one."""
GIVEN_UP = f"{UNFINISHED}: its worker process ended three times"
EVENTS_AT_ONCE = 100
_WORDS_LIMIT = 2000
_FINAL = [stage.value for stage in Stage if stage.is_final]
_BEFORE_TRIAL = (Stage.QUEUED.value, Stage.STATIC.value)
Change = Callable[[sa.Connection], None]
"""What holds as a part of a transaction, or not at all."""


class Held(Record):
    """A stage of a check in the hands of a worker.

    Attributes:
        id: Key of the check.
        worker: Its name.
        stage: What it does.
        order: What was asked for.
    """

    id: str
    worker: str
    stage: Stage
    order: Order


class Step(Record):
    """What a check comes to.

    Attributes:
        key: Of the event that tells it: it is told once, however often the step is taken.
        stage: The new stage.
        words: What is going on or went wrong, one sentence.
        result: Key of the stored report, where there is a new one.
        packages: As in `State`, with a new result.
        data: Of the event.
    """

    key: str
    stage: Stage
    words: str
    result: str = ""
    packages: Sequence[Mapping[str, Any]] = ()
    data: Mapping[str, Any] = field(default_factory=dict)


class Checks(Record, dict=True):
    """The table of checks, and that of their events."""

    engine: sa.Engine
    _writing: Lock = field(default_factory=Lock)

    def enter(self, id: str, order: Order, keep_seconds: float, step: Step, then: Change) -> None:
        """Write down a new check.

        Args:
            id: Key of a new one.
            order: What is asked for.
            keep_seconds: After which all of it is deleted.
            step: What it begins with.
            then: What else is to hold, or nothing does.
        """
        entry = {
            "id": id,
            "upload": order.upload,
            "name": order.name,
            "profile": order.profile,
            "keep_seconds": keep_seconds,
            **_values(step),
        }
        # SQLite has writers ask again after a while; among many, some would wait for seconds.
        with self._writing, self.engine.begin() as connection:
            connection.execute(self._entering, entry)
            self._tell(connection, id, step)
            then(connection)

    def begin(self, id: str, worker: str, step: Step) -> Held | None:
        """Write down that a worker begins a stage of a check.

        A worker that has it in hand still is dead: only then its workflow is run again.

        Args:
            id: Key of the check.
            worker: Name of the worker.
            step: What it does now; its stage says what the check must have come to.

        Returns:
            None if there is nothing to do any more: the check is over or further on.
        """
        before = (Stage.QUEUED, step.stage) if step.stage is Stage.STATIC else (step.stage,)
        with self.engine.begin() as connection:
            row = connection.execute(
                sa.select(CHECKS).where(CHECKS.c.id == id).with_for_update()
            ).one_or_none()
            if row is None or row.stage not in before:
                return None
            losses = [*row.losses, *_loss(row)]
            if len(losses) >= WORKERS_LOST:
                given_up = Step("end", Stage.FAILED, GIVEN_UP, data={"losses": losses})
                self._move(connection, id, given_up, losses=losses)
                return None
            self._move(connection, id, step, worker=worker, losses=losses)
            if len(losses) > len(row.losses):
                again = (
                    f"starts again: its worker process ended ({len(losses)} of {WORKERS_LOST} "
                    "times)"
                )
                self._tell(connection, id, Step(f"lost{len(losses)}", step.stage, again))
        order = Order(row.upload, row.name, row.profile)
        return Held(id, worker, step.stage, order)

    def settle(self, held: Held, step: Step, then: Change | None = None) -> bool:
        """Write down what a stage has come to; False if the worker has lost it before.

        Args:
            held: By the worker that asks.
            step: What the stage has come to.
            then: What else is to hold, or nothing does.
        """
        with self.engine.begin() as connection:
            moved = self._move(connection, held.id, step, *_is(held))
            if moved and then is not None:
                then(connection)
        return moved

    def release(self, held: Held) -> bool:
        """Let a stage go unfinished, through no fault of its own; False if it was lost before."""
        with self.engine.begin() as connection:
            waits = sa.update(CHECKS).where(*_is(held)).values(worker="", words=WAITS)
            return connection.execute(waits).rowcount == 1

    def holds(self, held: Held) -> bool:
        """Whether a worker still has a stage: not cancelled, not in the hands of another one."""
        with self.engine.connect() as connection:
            return connection.execute(sa.select(CHECKS.c.id).where(*_is(held))).first() is not None

    def cancel(self, id: str) -> bool:
        """End a check; False if it is over or unknown."""
        step = Step("end", Stage.CANCELLED, "cancelled")
        with self.engine.begin() as connection:
            return self._move(connection, id, step)

    def state(self, id: str) -> State | None:
        """Return where a check stands, with its key for an id; None if it is not known."""
        with self.engine.connect() as connection:
            row = connection.execute(sa.select(CHECKS).where(CHECKS.c.id == id)).one_or_none()
            if row is None:
                return None
            stage = Stage(row.stage)
            waits = not stage.is_final and not row.worker
            return State(
                id=id,
                order=Order(row.upload, row.name, row.profile),
                stage=stage,
                words=row.words,
                ahead=_ahead(connection, row) if waits else 0,
                created=row.created,
                result=row.result,
                packages=tuple(row.packages),
                expires=row.expires,
            )

    def events(self, id: str, after: int) -> Sequence[Event]:
        """Return what was told of a check after an event, in order."""
        events = sa.select(EVENTS).where(EVENTS.c.check_id == id, EVENTS.c.number > after)
        with self.engine.connect() as connection:
            rows = connection.execute(events.order_by(EVENTS.c.number).limit(EVENTS_AT_ONCE))
            return [
                Event(row.number, Stage(row.stage), row.words, row.time, row.data) for row in rows
            ]

    def last_events(self, ids: Collection[str]) -> Mapping[str, int]:
        """Return the number of the last event of each of these checks that is known."""
        last = sa.func.max(EVENTS.c.number).label("last")
        these = sa.select(EVENTS.c.check_id, last).where(EVENTS.c.check_id.in_(ids))
        question = these.group_by(EVENTS.c.check_id)
        with self.engine.connect() as connection:
            return {row.check_id: row.last for row in connection.execute(question)}

    def waiting(self) -> tuple[Mapping[str, int], int]:
        """Return how many checks wait, by queue, and how many are in hand."""
        in_hand = CHECKS.c.worker != ""
        with self.engine.connect() as connection:
            counted = connection.execute(
                sa.select(CHECKS.c.stage, in_hand, sa.func.count())
                .where(CHECKS.c.stage.not_in(_FINAL))
                .group_by(CHECKS.c.stage, in_hand)
            ).all()
        waiting = {"static": 0, "trial": 0}
        for stage, held, number in counted:
            waiting["static" if stage in _BEFORE_TRIAL else "trial"] += 0 if held else number
        return waiting, sum(number for _, held, number in counted if held)

    def _move(
        self,
        connection: sa.Connection,
        id: str,
        step: Step,
        *conditions: sa.ColumnElement[bool],
        **hand: Any,
    ) -> bool:
        """Take a step, unless the check is over or one of the conditions does not hold."""
        there = (CHECKS.c.id == id, CHECKS.c.stage.not_in(_FINAL), *conditions)
        values = {"worker": ""} | hand | _values(step)
        moved = connection.execute(sa.update(CHECKS).where(*there).values(values)).rowcount == 1
        if moved:
            self._tell(connection, id, step)
        return moved

    def _tell(self, connection: sa.Connection, id: str, step: Step) -> None:
        """Write an event, unless it was told before; the check's row is locked by now."""
        event = {
            "its_check": id,
            "its_key": step.key,
            "its_stage": step.stage.value,
            "its_words": _storable(step.words),
            "its_data": dict(step.data),
        }
        connection.execute(self._telling, event)
        tell(connection, id)

    @cached_property
    def _entering(self) -> sa.Insert:
        """What writes a check; to build a statement takes longer than to run it."""
        moment = now(self.engine)
        expires = moment + sa.bindparam("keep_seconds", type_=sa.Double)
        return sa.insert(CHECKS).values(created=moment, expires=expires)

    @cached_property
    def _telling(self) -> sa.Insert:
        """What writes an event."""
        check = sa.bindparam("its_check", type_=sa.Text)
        key = sa.bindparam("its_key", type_=sa.Text)
        exists = sa.exists().where(EVENTS.c.check_id == check, EVENTS.c.key == key)
        last = sa.select(sa.func.max(EVENTS.c.number)).where(EVENTS.c.check_id == check)
        event: dict[str, sa.ColumnElement[Any]] = {
            "check_id": check,
            "number": sa.func.coalesce(last.scalar_subquery(), 0) + 1,
            "key": key,
            "stage": sa.bindparam("its_stage", type_=sa.Text),
            "words": sa.bindparam("its_words", type_=sa.Text),
            "time": now(self.engine),
            "data": sa.bindparam("its_data", type_=sa.JSON),
        }
        chosen = sa.select(*event.values()).where(~exists)
        return sa.insert(EVENTS).from_select(list(event), chosen)


def _ahead(connection: sa.Connection, row: sa.Row[Any]) -> int:
    """Return how many checks wait in the same queue for longer."""
    stages = _BEFORE_TRIAL if row.stage in _BEFORE_TRIAL else (Stage.TRIAL.value,)
    longer = (CHECKS.c.stage.in_(stages), CHECKS.c.worker == "", CHECKS.c.created < row.created)
    question = sa.select(sa.func.count()).select_from(CHECKS).where(*longer)
    return int(connection.execute(question).scalar_one())


def forget(connection: sa.Connection, ids: Collection[str]) -> None:
    """Delete checks and all that was told of them."""
    connection.execute(sa.delete(EVENTS).where(EVENTS.c.check_id.in_(ids)))
    connection.execute(sa.delete(CHECKS).where(CHECKS.c.id.in_(ids)))


def _values(step: Step) -> dict[str, Any]:
    values: dict[str, Any] = {"stage": step.stage.value, "words": _storable(step.words)}
    if step.result:
        values |= {"result": step.result, "packages": [dict(package) for package in step.packages]}
    return values


def _is(held: Held) -> Sequence[sa.ColumnElement[bool]]:
    """Return the conditions under which a stage is in hand as it was."""
    return CHECKS.c.id == held.id, CHECKS.c.worker == held.worker, CHECKS.c.stage == held.stage


def _loss(row: sa.Row[Any]) -> list[dict[str, Any]]:
    """Return the worker that died with a check in hand, if one did."""
    if not row.worker:
        return []
    return [{"worker": row.worker, "stage": row.stage, "found": round(time.time(), 1)}]


def _storable(words: str) -> str:
    """Return words as any database takes them: PostgreSQL refuses a zero character."""
    return shortened(plain(words), _WORDS_LIMIT)
