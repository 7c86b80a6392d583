"""The table of checks: what was asked for, how far it is, and who has it in hand.

Every change is one transaction that holds only if the check is where it was thought to be: what a
worker says that was taken for dead and comes back is not written. Checks go by their keys here and
in all that follows (`checker.service.jobs.durable.tables`): a copy of the table opens no report.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property
from threading import Lock
from typing import Any

import sqlalchemy as sa
from msgspec import field

from checker.base.record import Record
from checker.service.jobs.durable.changes import tell
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.events import Events, storable
from checker.service.jobs.durable.queue import ahead, next_in, queue_of, rank, set_clock
from checker.service.jobs.durable.steps import Held, Step, Taker
from checker.service.jobs.durable.tables import CHECKS, EVENTS, FINAL, STAGES, WAITS, WORKERS
from checker.service.jobs.outcome import UNFINISHED
from checker.service.jobs.port import Order, Stage, State

PAUSES = (1.0, 5.0, 30.0, 120.0)
"""Seconds before each further try of what came to nothing through no fault of the package. A disk
that is full, or a machine that is out of memory, may need minutes."""
TRIES = len(PAUSES) + 1
"""The last one is alone on its machine."""
WORKER_ENDED = "its worker process ended"
_BEGINS = {
    Stage.STATIC: "the static rules are running",
    Stage.TRIAL: "the trial is running",
}


class Checks(Record, dict=True):
    """The table of checks; what becomes of one is told in that of events.

    Attributes:
        engine: Of the database.
        pauses: Seconds before each further try.
    """

    engine: sa.Engine
    pauses: Sequence[float] = PAUSES
    _writing: Lock = field(default_factory=Lock)

    def enter(
        self, id: str, secret: str, order: Order, keep_seconds: float, step: Step, cost: float
    ) -> bool:
        """Write down a new check; False if it is there already, which stays as it is.

        Args:
            id: Its key.
            secret: Digest of its secret.
            order: What is asked for.
            keep_seconds: After which all of it is deleted.
            step: What it begins with.
            cost: Seconds that its first stage takes, as far as one can tell.
        """
        entry = {
            "id": id,
            "secret": secret,
            "upload": order.upload,
            "name": order.name,
            "profile": order.profile,
            "keep_seconds": keep_seconds,
            "cost": cost,
            "sender": "" if step.stage.is_final else order.sender,
            "of_sender": order.sender,
            "of_cost": cost,
            **_values(step),
        }
        try:
            with self._turn, self.engine.begin() as connection:
                connection.execute(self._entering, entry)
                self.events.write(connection, id, step)
        except sa.exc.IntegrityError:
            if self.state(id) is None:
                raise
            return False
        return True

    def take(self, taker: Taker, stage: Stage, *, others: bool = False) -> Held | None:
        """Give the next check of a queue into the hands of a worker.

        Args:
            taker: The worker.
            stage: Of the queue.
            others: Whether only senders count of whom nothing is in hand.

        Returns:
            None if there is none, or if one is in hand that has to be alone.
        """
        question = next_in(stage, now(self.engine), others=others)
        while True:
            with self.engine.begin() as connection:
                row = connection.execute(question).one_or_none()
                if row is None or self._is_held_up(connection, taker):
                    return None
                step = Step(stage.value, stage, _BEGINS[stage])
                # Another worker may have been faster.
                if self._move(connection, row.id, step, *_as_in(row), worker=taker.name):
                    set_clock(connection, stage, row.rank)
                    order = Order(row.upload, row.name, row.profile, row.sender)
                    return Held(row.id, taker.name, stage, order, row.tries >= TRIES - 1)

    def _is_held_up(self, connection: sa.Connection, taker: Taker) -> bool:
        """Whether a check on the machine of a worker has to be alone."""
        alone = self._on_host(taker.host).where(CHECKS.c.tries >= TRIES - 1)
        return connection.execute(alone).first() is not None

    def is_alone(self, held: Held, taker: Taker) -> bool:
        """Whether nothing else is in hand on the machine of a worker."""
        # Of two that have to be alone, the first goes on.
        first = sa.or_(CHECKS.c.tries < TRIES - 1, CHECKS.c.id < held.id)
        others = self._on_host(taker.host).where(CHECKS.c.id != held.id, first)
        with self.engine.connect() as connection:
            return connection.execute(others).first() is None

    def _on_host(self, host: str) -> sa.Select[tuple[str]]:
        """Return the question for checks in hand on a machine."""
        workers = sa.select(WORKERS.c.name).where(WORKERS.c.host == host)
        in_hand = (CHECKS.c.stage.not_in(FINAL), CHECKS.c.worker.in_(workers))
        return sa.select(CHECKS.c.id).where(*in_hand).limit(1)

    def settle(self, held: Held, step: Step, cost: float = 0.0) -> bool:
        """Write down what a stage has come to; False if the worker has lost it before.

        Args:
            held: By the worker that asks.
            step: What the stage has come to.
            cost: Seconds that the next stage takes, as far as one can tell.
        """
        with self.engine.begin() as connection:
            place: dict[str, Any] = {}
            if not step.stage.is_final:
                place = {"cost": cost, "rank": rank(step.stage, held.order.sender, cost)}
            return self._move(connection, held.id, step, *_is(held), **place)

    def put_off(self, held: Held, reason: str) -> bool:
        """Have a stage tried again later, or give it up; False if the worker has lost it before.

        Args:
            held: By the worker that asks.
            reason: What happened to it, no fault of the package; the beginning of a sentence.
        """
        with self.engine.begin() as connection:
            row = connection.execute(sa.select(CHECKS).where(*_is(held))).one_or_none()
            return row is not None and self._again(connection, row, reason)

    def recover(self, is_dead: Callable[[str], bool]) -> Sequence[str]:
        """Have all be tried again that dead workers have in hand, and return their names.

        Args:
            is_dead: Whether a worker is dead, by its name.
        """
        held = sa.select(CHECKS).where(CHECKS.c.stage.not_in(FINAL), CHECKS.c.worker != "")
        with self.engine.connect() as connection:
            rows = connection.execute(held).all()
        dead = {name for name in {row.worker for row in rows} if is_dead(name)}
        for row in rows:
            if row.worker in dead:
                with self.engine.begin() as connection:
                    self._again(connection, row, WORKER_ENDED)
        return sorted(dead)

    def _again(self, connection: sa.Connection, row: sa.Row[Any], reason: str) -> bool:
        """Let go of a check that came to nothing, if it is still as it was."""
        loss = {
            "worker": row.worker,
            "stage": row.stage,
            "found": round(time.time(), 1),
            "reason": storable(reason),
        }
        tries = row.tries + 1
        lost: dict[str, Any] = {"losses": [*row.losses, loss], "tries": tries}
        if tries >= TRIES:
            words = f"{UNFINISHED}: {reason}; it was tried {TRIES} times, at last alone"
            step = Step("end", Stage.FAILED, words, data={"losses": lost["losses"]})
        else:
            pause = self.pauses[row.tries]
            words = f"starts again in {pause:g} s: {reason} (try {tries + 1} of {TRIES})"
            step = Step(f"again{tries}", Stage(row.stage), words)
            lost["not_before"] = now(self.engine) + pause
        return self._move(connection, row.id, step, *_as_in(row), **lost)

    def release(self, held: Held) -> bool:
        """Let a stage go unfinished, through no fault of its own; False if it was lost before."""
        with self.engine.begin() as connection:
            waits = sa.update(CHECKS).where(*_is(held)).values(worker="", words=WAITS)
            tell(connection, held.id)
            return connection.execute(waits).rowcount == 1

    def holds(self, held: Held) -> bool:
        """Whether a worker still has a stage: not cancelled, not in the hands of another one."""
        with self.engine.connect() as connection:
            return connection.execute(sa.select(CHECKS.c.id).where(*_is(held))).first() is not None

    def has_secret(self, id: str, secret: str) -> bool:
        """Whether a check has a secret, given by its digest."""
        question = sa.select(CHECKS.c.id).where(CHECKS.c.id == id, CHECKS.c.secret == secret)
        with self.engine.connect() as connection:
            return connection.execute(question).first() is not None

    def cancel(self, id: str) -> bool:
        """End a check; False if it is over or unknown."""
        step = Step("end", Stage.CANCELLED, "cancelled")
        with self.engine.begin() as connection:
            return self._move(connection, id, step)

    def delete(self, id: str) -> None:
        """Forget a check, wherever it stands; a worker that has it in hand loses it."""
        with self.engine.begin() as connection:
            forget(connection, [id])

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
                order=Order(row.upload, row.name, row.profile, row.sender),
                stage=stage,
                words=row.words,
                ahead=ahead(connection, row) if waits else 0,
                created=row.created,
                result=row.result,
                packages=tuple(row.packages),
                expires=row.expires,
            )

    def waiting(self) -> tuple[Mapping[str, int], int]:
        """Return how many checks wait, by queue, and how many are in hand."""
        in_hand = CHECKS.c.worker != ""
        with self.engine.connect() as connection:
            counted = connection.execute(
                sa.select(CHECKS.c.stage, in_hand, sa.func.count())
                .where(CHECKS.c.stage.not_in(FINAL))
                .group_by(CHECKS.c.stage, in_hand)
            ).all()
        waiting = {stage.value: 0 for stage in STAGES}
        for stage, held, number in counted:
            waiting[queue_of(stage).value] += 0 if held else number
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
        there = (CHECKS.c.id == id, CHECKS.c.stage.not_in(FINAL), *conditions)
        values = {"worker": ""} | hand | _values(step)
        if step.stage.is_final:
            values["sender"] = ""
        moved = connection.execute(sa.update(CHECKS).where(*there).values(values)).rowcount == 1
        if moved:
            self.events.write(connection, id, step)
        return moved

    @property
    def _turn(self) -> AbstractContextManager[object]:
        """A turn of this process to write into SQLite, which has writers ask again after a while.

        Among many, some would wait for seconds.
        """
        return self._writing if self.engine.dialect.name == "sqlite" else nullcontext()

    @cached_property
    def events(self) -> Events:
        """The table of events."""
        return Events(self.engine)

    @cached_property
    def _entering(self) -> sa.Insert:
        """What writes a check; to build a statement takes longer than to run it."""
        moment = now(self.engine)
        expires = moment + sa.bindparam("keep_seconds", type_=sa.Double)
        own = (sa.bindparam("of_sender", type_=sa.Text), sa.bindparam("of_cost", type_=sa.Double))
        place = rank(Stage.STATIC, *own)
        return sa.insert(CHECKS).values(created=moment, expires=expires, rank=place)


def forget(connection: sa.Connection, ids: Collection[str]) -> None:
    """Delete checks and all that was told of them.

    The checks first: then none of them can take a step any more that would be told behind it.
    """
    connection.execute(sa.delete(CHECKS).where(CHECKS.c.id.in_(ids)))
    connection.execute(sa.delete(EVENTS).where(EVENTS.c.check_id.in_(ids)))


def _values(step: Step) -> dict[str, Any]:
    values: dict[str, Any] = {"stage": step.stage.value, "words": storable(step.words)}
    if step.result:
        values |= {"result": step.result, "packages": [dict(package) for package in step.packages]}
    return values


def _is(held: Held) -> Sequence[sa.ColumnElement[bool]]:
    """Return the conditions under which a stage is in hand as it was."""
    return CHECKS.c.id == held.id, CHECKS.c.worker == held.worker, CHECKS.c.stage == held.stage


def _as_in(row: sa.Row[Any]) -> Sequence[sa.ColumnElement[bool]]:
    """Return the conditions under which a check is where a row of the table has it."""
    return (
        CHECKS.c.worker == row.worker,
        CHECKS.c.stage == row.stage,
        CHECKS.c.tries == row.tries,
    )
