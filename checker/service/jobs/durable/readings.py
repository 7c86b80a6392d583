"""What the book of checks says, in few and cheap questions: many watch a check at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sqlalchemy as sa

from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.database import now
from checker.service.jobs.durable.tables import CHECKS, EVENTS, WORKERS
from checker.service.jobs.port import Alive, Event, Order, Stage, State

EVENTS_AT_ONCE = 100
_BEFORE_TRIAL = (Stage.QUEUED.value, Stage.STATIC.value)


def state_of(connection: sa.Connection, id: str) -> State | None:
    """Return where a check stands, with its key for an id; None if it is not in the book."""
    found = connection.execute(sa.select(CHECKS).where(CHECKS.c.id == id)).one_or_none()
    if found is None:
        return None
    stage = Stage(found.stage)
    waits = not stage.is_final and not found.worker
    return State(
        id=id,
        order=Order(found.upload, found.name, found.profile),
        stage=stage,
        words=found.words,
        ahead=_ahead(connection, found) if waits else 0,
        created=found.created,
        result=found.result,
        packages=tuple(found.packages),
        expires=found.expires,
    )


def events_of(connection: sa.Connection, id: str, after: int) -> Sequence[Event]:
    """Return what was told of a check after an event, in order."""
    told = sa.select(EVENTS).where(EVENTS.c.check_id == id, EVENTS.c.number > after)
    rows = connection.execute(told.order_by(EVENTS.c.number).limit(EVENTS_AT_ONCE))
    return [Event(row.number, Stage(row.stage), row.words, row.time, row.data) for row in rows]


def alive(engine: sa.Engine, connection: sa.Connection) -> Alive:
    """Return who works and how much there is to do."""
    silence = (now(engine) - WORKERS.c.beat).label("silence")
    workers = connection.execute(sa.select(WORKERS.c.name, silence, WORKERS.c.layers)).all()
    final = [stage.value for stage in Stage if stage.is_final]
    in_hand = CHECKS.c.worker != ""
    open_checks = connection.execute(
        sa.select(CHECKS.c.stage, in_hand, sa.func.count())
        .where(CHECKS.c.stage.not_in(final))
        .group_by(CHECKS.c.stage, in_hand)
    ).all()
    waiting = {"static": 0, "trial": 0}
    for stage, taken, number in open_checks:
        waiting["static" if stage in _BEFORE_TRIAL else "trial"] += 0 if taken else number
    return Alive(
        workers={each.name: max(0.0, each.silence) for each in workers},
        waiting=waiting,
        running=sum(number for _, taken, number in open_checks if taken),
        layers={each.name: [Layer(**said) for said in each.layers or ()] for each in workers},
    )


def _ahead(connection: sa.Connection, found: sa.Row[Any]) -> int:
    """Return how many checks wait in the same queue for longer."""
    stages = _BEFORE_TRIAL if found.stage in _BEFORE_TRIAL else (Stage.TRIAL.value,)
    longer = (CHECKS.c.stage.in_(stages), CHECKS.c.worker == "", CHECKS.c.created < found.created)
    question = sa.select(sa.func.count()).select_from(CHECKS).where(*longer)
    return int(connection.execute(question).scalar_one())
