"""What is known of each check, and who has it in hand.

Every change is one transaction that holds only if the check is where it was thought to be. A worker
that was taken for dead and comes back finds that it has lost its turn, and what it says is not
written. Checks go by their keys here and in all that follows (`keys.py`): who has
a copy of the book opens no report by it.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any

import sqlalchemy as sa
from msgspec import field

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.queues import WAITS
from checker.service.jobs.durable.tables import CHECKS, EVENTS
from checker.service.jobs.durable.together import Change, Together
from checker.service.jobs.outcome import UNFINISHED
from checker.service.jobs.port import Order, Stage

WORKERS_LOST = 3
"""A check that so many workers died of is not given to another one."""
GIVEN_UP = f"{UNFINISHED}: its worker died three times"
_WORDS_LIMIT = 2000
_FINAL = [stage.value for stage in Stage if stage.is_final]


class Turn(Record):
    """A check in the hands of a worker.

    Attributes:
        id: Key of the check.
        number: Goes up whenever the check changes hands.
        order: What was asked for.
    """

    id: str
    number: int
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


class Ledger(Record, dict=True):
    """The book of checks."""

    engine: sa.Engine

    def enter(self, id: str, order: Order, keep_seconds: float, step: Step, then: Change) -> None:
        """Write a new check into the book.

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

        def enter(connection: sa.Connection) -> None:
            connection.execute(self._entering, entry)
            self._tell(connection, id, step)
            then(connection)

        self._together.make(enter)

    def take(self, id: str, worker: str, step: Step) -> Turn | None:
        """Give a check to a worker.

        A worker that has it in hand still is dead: only then the queue gives a check out again.

        Args:
            id: Key of the check.
            worker: Name of the worker.
            step: What it does now; its stage says what the check must have come to.

        Returns:
            None if there is nothing to do any more: it is over, further on, or with another one.
        """
        before = (Stage.QUEUED, step.stage) if step.stage is Stage.STATIC else (step.stage,)
        with self.engine.begin() as connection:
            found = connection.execute(
                sa.select(CHECKS).where(CHECKS.c.id == id).with_for_update()
            ).one_or_none()
            if found is None or found.stage not in before:
                return None
            losses = [*found.losses, *_loss(found)]
            if len(losses) >= WORKERS_LOST:
                given_up = Step("end", Stage.FAILED, GIVEN_UP, data={"losses": losses})
                self._move(connection, id, found.turn, given_up, losses=losses)
                return None
            if not self._move(connection, id, found.turn, step, worker=worker, losses=losses):
                return None
            if len(losses) > len(found.losses):
                again = f"begins again: its worker died ({len(losses)} of {WORKERS_LOST} times)"
                self._tell(connection, id, Step(f"lost{len(losses)}", step.stage, again))
        order = Order(found.upload, found.name, found.profile)
        return Turn(id, found.turn + 1, order)

    def settle(self, turn: Turn, step: Step, then: Change | None = None) -> bool:
        """Write what became of a turn, which is over; False if it was lost before.

        Args:
            turn: Of the worker that asks.
            step: What became of it.
            then: What else is to hold, or nothing does.
        """
        with self.engine.begin() as connection:
            moved = self._move(connection, turn.id, turn.number, step)
            if moved and then is not None:
                then(connection)
        return moved

    def release(self, turn: Turn) -> bool:
        """Let a check go unfinished, through no fault of its own; False if it was lost before."""
        with self.engine.begin() as connection:
            there = (CHECKS.c.id == turn.id, CHECKS.c.turn == turn.number)
            done = connection.execute(
                sa.update(CHECKS).where(*there).values(_next_hand("") | {"words": WAITS})
            )
        return done.rowcount == 1

    def wanted(self, turn: Turn) -> bool:
        """Whether a worker still has its turn: not cancelled, not taken by another one."""
        with self.engine.connect() as connection:
            number = connection.execute(
                sa.select(CHECKS.c.turn).where(CHECKS.c.id == turn.id)
            ).scalar()
        return number == turn.number

    def cancel(self, id: str) -> bool:
        """End a check; False if it is over or unknown."""
        step = Step("end", Stage.CANCELLED, "cancelled")
        with self.engine.begin() as connection:
            return self._move(connection, id, None, step)

    def _move(
        self, connection: sa.Connection, id: str, turn: int | None, step: Step, **hand: Any
    ) -> bool:
        """Take a step, unless the check is over or has changed hands; at any turn if None."""
        there = [CHECKS.c.id == id, CHECKS.c.stage.not_in(_FINAL)]
        if turn is not None:
            there.append(CHECKS.c.turn == turn)
        values = _next_hand("") | hand | _values(step)
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
            "its_words": _said(step.words),
            "its_data": dict(step.data),
        }
        connection.execute(self._telling, event)

    @cached_property
    def _together(self) -> Together:
        return Together(self.engine)

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
        told = sa.exists().where(EVENTS.c.check_id == check, EVENTS.c.key == key)
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
        chosen = sa.select(*event.values()).where(~told)
        return sa.insert(EVENTS).from_select(list(event), chosen)


def forget(connection: sa.Connection, ids: Collection[str]) -> None:
    """Delete checks and all that was told of them."""
    connection.execute(sa.delete(EVENTS).where(EVENTS.c.check_id.in_(ids)))
    connection.execute(sa.delete(CHECKS).where(CHECKS.c.id.in_(ids)))


def _values(step: Step) -> dict[str, Any]:
    values: dict[str, Any] = {"stage": step.stage.value, "words": _said(step.words)}
    if step.result:
        values |= {"result": step.result, "packages": [dict(each) for each in step.packages]}
    return values


def _next_hand(worker: str) -> dict[str, Any]:
    return {"worker": worker, "turn": CHECKS.c.turn + 1}


def _loss(found: sa.Row[Any]) -> list[dict[str, Any]]:
    """Return the worker that died with a check in hand, if one did."""
    if not found.worker:
        return []
    return [{"worker": found.worker, "stage": found.stage, "found": round(time.time(), 1)}]


def _said(words: str) -> str:
    """Return words as any database takes them: PostgreSQL refuses a zero character."""
    return shortened(plain(words), _WORDS_LIMIT)
