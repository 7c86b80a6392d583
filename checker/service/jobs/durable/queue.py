"""Which check is next: fair among senders, short ones before long ones, and none for ever last.

Each stage has a queue. A check that enters it is given a rank, and the lowest is next. The rank is
the time at which the check would be over if all senders were served side by side, each with an
equal share of one processor (weighted fair queueing, Demers, Keshav and Shenker 1989), and each had
its own shorter checks done before its longer ones. The clock of that imagined processor stands at
the highest rank of all that was taken.

So the first check of somebody who sends one comes before the fifth of somebody who sends a hundred,
and a long one comes at the latest when as much has been done for each other sender.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sqlalchemy as sa

from checker.service.jobs.durable.tables import CHECKS, QUEUES
from checker.service.jobs.port import Stage

_BEFORE_TRIAL = (Stage.QUEUED.value, Stage.STATIC.value)


def stands_in(stage: Stage) -> Sequence[str]:
    """Return how the table calls checks in the queue of a stage, waiting or in hand."""
    return (Stage.TRIAL.value,) if stage is Stage.TRIAL else _BEFORE_TRIAL


def queue_of(stage: str) -> Stage:
    """Return the queue of a check by how far it is."""
    return Stage.STATIC if stage in _BEFORE_TRIAL else Stage.TRIAL


def rank(
    stage: Stage,
    sender: str | sa.BindParameter[str],
    cost: float | sa.BindParameter[float],
) -> sa.ColumnElement[float]:
    """Return the rank of a check that enters a queue, as the database works it out.

    Args:
        stage: Of the queue.
        sender: Who asks.
        cost: Of the check, seconds.
    """
    shorter = (CHECKS.c.sender == sender, CHECKS.c.cost <= cost, CHECKS.c.worker == "")
    before = sa.select(sa.func.coalesce(sa.func.sum(CHECKS.c.cost), 0.0)).where(
        CHECKS.c.stage.in_(stands_in(stage)), *shorter
    )
    clock = sa.select(QUEUES.c.moment).where(QUEUES.c.stage == stage.value)
    return clock.scalar_subquery() + before.scalar_subquery() + cost


def set_clock(connection: sa.Connection, stage: Stage, rank: float) -> None:
    """Set the clock of a queue to the rank of what was taken, unless it is further on."""
    later = (QUEUES.c.stage == stage.value, QUEUES.c.moment < rank)
    connection.execute(sa.update(QUEUES).where(*later).values(moment=rank))


def next_in(stage: Stage, moment: sa.ColumnElement[float], *, others: bool) -> sa.Select[Any]:
    """Return the question for the check that is next.

    Args:
        stage: Of the queue.
        moment: Now, by the clock of the database.
        others: Whether only senders count of whom nothing is in hand.
    """
    there = (CHECKS.c.stage.in_(stands_in(stage)), CHECKS.c.not_before <= moment)
    question = sa.select(CHECKS).where(*there, CHECKS.c.worker == "")
    if others:
        busy = CHECKS.alias()
        served = sa.select(busy.c.sender).where(
            busy.c.stage.in_(stands_in(stage)), busy.c.worker != ""
        )
        question = question.where(CHECKS.c.sender.not_in(served))
    return question.order_by(CHECKS.c.rank, CHECKS.c.created).limit(1)


def ahead(connection: sa.Connection, row: sa.Row[Any]) -> int:
    """Return how many checks that wait come before one that waits."""
    earlier = sa.or_(
        CHECKS.c.rank < row.rank,
        (CHECKS.c.rank == row.rank) & (CHECKS.c.created < row.created),
    )
    there = (CHECKS.c.stage.in_(stands_in(queue_of(row.stage))), CHECKS.c.worker == "", earlier)
    question = sa.select(sa.func.count()).select_from(CHECKS).where(*there)
    return int(connection.execute(question).scalar_one())
